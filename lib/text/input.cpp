// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/input.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/error.h"

namespace rolling {
namespace {
constexpr std::size_t block = 1 << 18;

/// read(2), repeated after a signal, and waiting if another process has made the descriptor
/// non-blocking.
ssize_t read_some(int fd, char* to, std::size_t size) {
  for (;;) {
    const ssize_t count = ::read(fd, to, size);
    if (count >= 0 || (errno != EINTR && errno != EAGAIN)) return count;
    pollfd ready{fd, POLLIN, 0};
    if (errno == EAGAIN) ::poll(&ready, 1, -1);
  }
}

int open_for_reading(const std::string& name) {
  refuse_output(name);  // first: if standard output is closed, open() may return its number
  return name == "-" ? STDIN_FILENO : ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
}

}  // namespace

void refuse_output(const std::string& name) {
  struct stat in, out;
  if ((name == "-" ? ::fstat(STDIN_FILENO, &in) : ::stat(name.c_str(), &in)) == 0 &&
      ::fstat(STDOUT_FILENO, &out) == 0 && S_ISREG(in.st_mode) && in.st_dev == out.st_dev &&
      in.st_ino == out.st_ino)
    fail<InputError>("{}: this input is the output too", name);
}

Input::Input(std::string name)
    : name_(std::move(name)), fd_(open_for_reading(name_)), at_(buffer_.reserve(block)), end_(at_) {
  if (fd_ < 0) fail<InputError>("{}: {}", name_.empty() ? "''" : name_, std::strerror(errno));
#ifdef F_SETPIPE_SZ
  // A larger pipe lets the tools of a chain wait less for each other. Failure does no harm.
  ::fcntl(fd_, F_SETPIPE_SZ, 1 << 20);
#endif
  struct stat status;
  has_size_ = ::fstat(fd_, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0;
}

Input::~Input() {
  if (fd_ > STDIN_FILENO) ::close(fd_);
}

bool Input::fill() {
  const std::size_t kept = ahead().size();
  if (kept >= longest_line)
    fail<InputError>("{}:{}: a line of more than {} bytes", name_, line_number_ + 1, longest_line);
  buffer_.erase_front(static_cast<std::size_t>(at_ - buffer_.data()));
  char* const to = buffer_.reserve(block);
  const ssize_t count = read_some(fd_, to, std::min(block, longest_line - kept));
  at_ = buffer_.data(), end_ = to;
  if (count < 0) fail<InputError>("{}: {}", name_, std::strerror(errno));
  buffer_.set_end(to + count);
  end_ += count;
  return count > 0;
}

/// Reads on until the end of the line at at_, whose line feed is not in memory yet, and returns it;
/// null if there is no further line.
const char* Input::end_of_line() {
  for (std::size_t searched = 0; !at_end_;) {
    searched = static_cast<std::size_t>(end_ - at_);
    at_end_ = !fill();
    const void* const feed =
        std::memchr(at_ + searched, '\n', static_cast<std::size_t>(end_ - at_) - searched);
    if (feed) return static_cast<const char*>(feed);
  }
  return at_ == end_ ? nullptr : end_;
}

bool Input::next(std::string_view& line) {
  const char* feed =
      static_cast<const char*>(std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_)));
  if (!feed && !(feed = end_of_line())) return false;
  line = {at_, feed};
  at_ = feed == end_ ? feed : feed + 1;
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  ++line_number_;
  // Joined files have a byte order mark each, and one that has nothing else leaves two together.
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  while (line.starts_with(mark)) line.remove_prefix(mark.size());
  return true;
}

}  // namespace rolling
