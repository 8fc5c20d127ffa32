// The exception type of the library. Its message is one line for the user. Tool::run() catches it.
#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <utility>

namespace rolling {

class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An error whose message names the file, and the line where there is one.
class InputError : public Error {
 public:
  using Error::Error;
};

/// Throws Error, or another kind, with a formatted message.
template <typename Kind = Error, typename... Args>
[[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args) {
  throw Kind(fmt::format(text, std::forward<Args>(args)...));
}

}  // namespace rolling
