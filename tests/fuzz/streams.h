// SPDX-License-Identifier: GPL-3.0-or-later
// The standard streams of a tool that runs within this process, kept in memory.
#pragma once

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

/// Ends the process, as the fuzzer wants it, where what must hold does not.
inline void require(bool holds, const char* what, std::string_view shown = "") {
  if (holds) return;
  std::fprintf(stderr, "%s: '%s'\n", what, std::string(shown).c_str());
  std::abort();
}

/// A file in memory.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view content = {}) : fd_(::memfd_create("fuzz", MFD_CLOEXEC)) {
    require(fd_ >= 0 && ::write(fd_, content.data(), content.size()) ==
                            static_cast<ssize_t>(content.size()),
            "no memory file");
    ::lseek(fd_, 0, SEEK_SET);
  }
  ~MemoryFile() { ::close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int fd() const { return fd_; }
  std::string path() const { return "/proc/self/fd/" + std::to_string(fd_); }
  std::string content() const {
    std::string text(static_cast<std::size_t>(::lseek(fd_, 0, SEEK_END)), '\0');
    require(::pread(fd_, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size()),
            "a memory file cannot be read");
    return text;
  }

 private:
  int fd_;
};

struct Ran {
  int status;
  std::string out, err;
};

/// What `call` returns and prints when it reads `input`.
template <typename Call>
Ran with_streams(std::string_view input, Call&& call) {
  static const bool limited = [] {  // a billion rows are no way to spend a minute
    const rlimit size{1 << 22, RLIM_INFINITY};
    return ::setrlimit(RLIMIT_FSIZE, &size) == 0;
  }();
  require(limited, "no limit of the file size");
  const MemoryFile files[] = {MemoryFile(input), MemoryFile(), MemoryFile()};
  int kept[3];
  for (int i = 0; i < 3; ++i) kept[i] = ::dup(i), ::dup2(files[i].fd(), i);
  const int status = call();
  for (int i = 0; i < 3; ++i) ::dup2(kept[i], i), ::close(kept[i]);
  return {status, files[1].content(), files[2].content()};
}

/// The contract of every tool: 0 and finite numbers, or 1 or 2 and one short line of printable
/// ASCII that says why.
inline void check_contract(const Ran& ran, std::string_view tool) {
  require(ran.status >= 0 && ran.status <= 2, "exit status", std::to_string(ran.status));
  if (ran.status > 0) require(!ran.err.empty(), "no word on standard error");
  if (ran.status == 0) require(!ran.out.empty(), "nothing on standard output");
  const bool whole = ran.out.empty() || ran.out.back() == '\n' ||
                     ran.err.find("File too large") != std::string::npos;
  require(whole, "half a row", ran.out);
  for (std::size_t at = 0; at < ran.err.size();) {
    const std::size_t end = ran.err.find('\n', at);
    require(end != std::string::npos, "half a message", ran.err);
    const std::string_view line = std::string_view(ran.err).substr(at, end - at);
    require(
        line.size() < 512 && line.starts_with(tool) && line.substr(tool.size()).starts_with(": "),
        "a message of another form", line);
    for (const char c : line) require(c >= ' ' && c <= '~', "a message that is not ASCII", line);
    at = end + 1;
  }
}
