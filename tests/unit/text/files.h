// SPDX-License-Identifier: GPL-3.0-or-later
// For tests: input from temporary files, standard output into one, and what an error says.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <string_view>

#include "base/error.h"
#include "unit/catch.h"

namespace rolling {

/// How the names of temporary files begin.
inline std::string temporary_name() {
  const char* folder = std::getenv("TMPDIR");
  return std::string(folder ? folder : "/tmp") + "/rolling-unit-";
}

/// A file with this text; gone with the object.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string_view text = {}) {
    const int fd = ::mkstemp(name_.data());
    REQUIRE(fd >= 0);
    REQUIRE(::write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size()));
    REQUIRE(::close(fd) == 0);
  }
  ~TemporaryFile() { ::unlink(name_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& name() const { return name_; }
  std::string text() const {
    std::string all(1 << 20, '\0');
    const int fd = ::open(name_.c_str(), O_RDONLY | O_CLOEXEC);
    const ssize_t count = ::read(fd, all.data(), all.size());
    REQUIRE(count >= 0);
    REQUIRE(::close(fd) == 0);
    all.resize(static_cast<std::size_t>(count));
    return all;
  }

 private:
  std::string name_ = temporary_name() + std::string(6, 'X');  // mkstemp's template
};

/// Another file in the place of a standard one, as long as the object lives.
class Redirect {
 public:
  Redirect(int standard, const std::string& file) : standard_(standard), saved_(::dup(standard)) {
    const int fd =
        ::open(file.c_str(), (standard == STDIN_FILENO ? O_RDONLY : O_WRONLY) | O_CLOEXEC);
    REQUIRE(fd >= 0);
    REQUIRE(::dup2(fd, standard_) == standard_);
    ::close(fd);
  }
  ~Redirect() {
    ::dup2(saved_, standard_);
    ::close(saved_);
  }
  Redirect(const Redirect&) = delete;
  Redirect& operator=(const Redirect&) = delete;

 private:
  int standard_, saved_;
};

/// What `work` prints on standard output. (No assertion in `work`: Catch prints there too.)
template <typename Work>
std::string printed(const Work& work) {
  const TemporaryFile file;
  {
    const Redirect to_file(STDOUT_FILENO, file.name());
    work();
  }
  return file.text();
}

/// What the Error says that `work` throws; empty if it throws none.
template <typename Work>
std::string refusal(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

/// `text` with each temporary file's name as FILE.
inline std::string anonymous(std::string text) {
  const std::string name = temporary_name();
  for (auto at = text.find(name); at != std::string::npos; at = text.find(name))
    text.replace(at, name.size() + 6, "FILE");
  return text;
}

}  // namespace rolling
