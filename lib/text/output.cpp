// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/output.h"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace rolling {

constexpr std::string_view names_run = "## run ";

std::string names_line(const std::vector<Column>& columns) {
  std::string line;
  for (const Column& column : columns) {
    std::string name = to_text(column);
    if (name.starts_with(quote) || name.starts_with('#')) name = quoted(name);
    (line += line.empty() ? "# " : "\t") += name;
  }
  return line;
}

void Output::header(const std::string& whole) {
  if (!plain) return line(whole);
  const std::string names = whole.substr(2);
  const bool has_run = ('\t' + names + '\t').find("\trun\t") != std::string::npos;
  const bool needs_run = !run_.empty() && !has_run;
  if (header_.empty()) {
    header_ = names;
    line(needs_run ? names + "\trun" : names);
    with_run_ = needs_run;
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
  // The signals that end a tool wait, so that they do not cut a line in two.
  sigset_t ending;
  sigset_t before;
  sigemptyset(&ending);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ending, signal);
  pthread_sigmask(SIG_BLOCK, &ending, &before);
  int reason = 0;
  std::string_view left(buffer_.data(), buffer_.size());
  while (!left.empty() && reason == 0) {
    const ssize_t count = ::write(STDOUT_FILENO, left.data(), left.size());
    if (count >= 0) {
      written_ = true;
      torn_ = left[static_cast<std::size_t>(count) - 1] != '\n';
      left.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno == EAGAIN) {  // another process has made it non-blocking
      pollfd ready{STDOUT_FILENO, POLLOUT, 0};
      ::poll(&ready, 1, -1);
    } else if (errno != EINTR) {
      reason = errno;
    }
  }
  whole_ = 0;
  drop_line();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (reason == EPIPE) fail<ReaderGone>("standard output: {}", std::strerror(reason));
  if (reason != 0) fail<CompleteError>("standard output: {}", std::strerror(reason));
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
