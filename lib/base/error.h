// The one exception type: trouble that the user can read about in one line. Every command catches
// it in one place.
#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <utility>

namespace rolling {

class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One that says itself where in the input the trouble is.
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
