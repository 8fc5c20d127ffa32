// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/output.h"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace rolling {
namespace {

constexpr std::string_view names_run = "## run ";

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
    if (name.starts_with(quote) || name.starts_with('#'))
      name = fmt::format("\"{}\"", replace_all(name, {{"\"", "\"\""}}));
    (line += line.empty() ? "# " : "\t") += name;
  }
  return line;
}

void Output::header(const std::string& line) {
  if (!plain) return this->line(line);
  const std::string names = line.substr(2);
  const bool has_run = ('\t' + names + '\t').find("\trun\t") != std::string::npos;
  const bool needs_run = !run_.empty() && !has_run;
  if (header_.empty()) {
    header_ = names;
    with_run_ = needs_run;
    text(names);
    const std::string run = std::exchange(run_, "run");  // what the line ends with
    end_line();
    run_ = run;
  }
  if (names != header_) fail("--plain prints one table, and these columns are not those before");
  if (needs_run && !with_run_)
    fail("--plain has printed runs without their names: put a line `## run NAME` above each");
}

void Output::run_among(const std::vector<std::string>& comments) {
  for (const std::string& comment : comments)
    if (comment.starts_with(names_run)) line(comment);
}

/// Adds the run to a row; takes any other line away, and returns false.
bool Output::end_plain_line() {
  const std::string_view line(buffer_.data() + whole_, buffer_.size() - whole_);
  if (line.starts_with(names_run)) run_ = line.substr(names_run.size());
  if (line.empty() || line.starts_with('#')) {
    drop_line();
    return false;
  }
  if (with_run_) {
    text('\t');
    append_field(buffer_, run_);
  }
  return true;
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
      fail<CompleteError>("standard output: {}", std::strerror(reason));
    }
    written_ = true;
    torn_ = left[static_cast<std::size_t>(count) - 1] != '\n';
    left.remove_prefix(static_cast<std::size_t>(count));
  }
  whole_ = 0;
  drop_line();
}

void Output::end_with(std::string_view line) noexcept {
  plain = false;  // whoever reads the rows sees that they are not complete
  drop_line();
  if (!written_ && buffer_.size() == 0) return;
  try {
    if (torn_) text('\n');
    this->line(line);
    flush();
  } catch (...) {  // the error of the output has been reported already
  }
}

}  // namespace rolling
