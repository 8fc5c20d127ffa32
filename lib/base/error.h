// The one exception type: trouble that the user can read about in one line. Every command catches it in one place.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace rolling {

class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws Error with a formatted message.
template <typename... Args>
[[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args) {
  throw Error(fmt::format(text, std::forward<Args>(args)...));
}

}  // namespace rolling
