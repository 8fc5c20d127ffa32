// SPDX-License-Identifier: GPL-3.0-or-later
// The exception type of the library. Its message is one line for the user. Tool::run() catches it.
#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <string_view>

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

/// An error of the options, which names no row, whatever has been read.
class OptionError : public Error {
 public:
  using Error::Error;
};

/// The readings show no motion of the kind that is asked for: perhaps the columns are not those
/// that are meant.
class MotionError : public Error {
 public:
  using Error::Error;
};

template <typename Kind>
[[noreturn]] void throw_formatted(fmt::string_view text, fmt::format_args args) {
  throw Kind(fmt::vformat(text, args));
}

/// Throws Error, or another kind, with a formatted message.
template <typename Kind = Error, typename... Args>
[[noreturn]] void fail(fmt::format_string<Args...> text, const Args&... args) {
  throw_formatted<Kind>(text, fmt::make_format_args(args...));
}

}  // namespace rolling
