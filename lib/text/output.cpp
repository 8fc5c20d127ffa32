// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/output.h"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace rolling {
namespace {

/// Blocks the signals that end a tool while it writes, so that they do not cut a line in two.
class SignalsWait {
 public:
  SignalsWait() {
    sigset_t ending;
    sigemptyset(&ending);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ending, signal);
    pthread_sigmask(SIG_BLOCK, &ending, &before_);
  }
  ~SignalsWait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_;
};

}  // namespace

std::string names_line(const std::vector<Column>& columns) {
  std::string line;
  for (const Column& column : columns) {
    std::string name = to_text(column);
    if (name.starts_with(quote)) name = fmt::format("\"{}\"", replace_all(name, {{"\"", "\"\""}}));
    (line += line.empty() ? "# " : "\t") += name;
  }
  return line;
}

void Output::names(const std::vector<Column>& columns) {
  text(names_line(columns));
  end_line();
}

void Output::flush() {
  const SignalsWait waiting;
  for (std::string_view left(buffer_.data(), buffer_.size()); !left.empty();) {
    const ssize_t count = ::write(STDOUT_FILENO, left.data(), left.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) {  // another process has made it non-blocking
      pollfd ready{STDOUT_FILENO, POLLOUT, 0};
      ::poll(&ready, 1, -1);
      continue;
    }
    if (count < 0) {
      const int reason = errno;
      whole_ = 0;
      drop_line();
      fail<OutputError>("standard output: {}", std::strerror(reason));
    }
    written_ = true;
    torn_ = left[static_cast<std::size_t>(count) - 1] != '\n';
    left.remove_prefix(static_cast<std::size_t>(count));
  }
  whole_ = 0;
  drop_line();
}

void Output::end_with(std::string_view line) noexcept {
  drop_line();
  if (!written_ && buffer_.size() == 0) return;
  try {
    if (torn_) text('\n');
    text(line);
    end_line();
    flush();
  } catch (...) {  // the error of the output has been reported already
  }
}

}  // namespace rolling
