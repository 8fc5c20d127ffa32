// SPDX-License-Identifier: GPL-3.0-or-later
// The exception type of the library. Its message is one line for the user. Tool::run() catches it.
#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <string_view>

namespace rolling {

struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An error whose message is complete: no row of the input is to be named beside it.
struct CompleteError : Error {
  using Error::Error;
};
/// Nobody reads the output any more.
struct ReaderGone : CompleteError {
  using CompleteError::CompleteError;
};
/// It names the file, and the line where there is one.
struct InputError : CompleteError {
  using CompleteError::CompleteError;
};
/// It is one of the options, whatever has been read.
struct OptionError : CompleteError {
  using CompleteError::CompleteError;
};

// Numeric code knows no option: it throws what the readings show, and cli/tool.cpp has the way out.

/// The readings show no motion of the kind that is asked for: perhaps the columns are not those
/// that are meant.
struct MotionError : Error {
  using Error::Error;
};
/// They are hardly those of one roll: no law comes out.
struct NotOneRoll : MotionError {
  using MotionError::MotionError;
};
/// They go one way, where a slope or a wind acts as the law does.
struct OneWay : MotionError {
  using MotionError::MotionError;
};
/// They do not determine the exponent.
struct LooseExponent : MotionError {
  using MotionError::MotionError;
};
/// There is no roll among them.
struct NoFreeRoll : MotionError {
  using MotionError::MotionError;
};
/// They are of a body that comes back.
struct WayBack : MotionError {
  using MotionError::MotionError;
};
/// One of them is off the motion of the others.
struct ReadingOff : Error {
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

/// What `work` returns. An Error that names no file becomes an InputError at this place, a text
/// that `place` returns.
template <typename Place, typename Work>
auto located(const Place& place, const Work& work) {
  try {
    return work();
  } catch (const InputError&) {
    throw;
  } catch (const Error& error) {
    fail<InputError>("{}: {}", place(), error.what());
  }
}

}  // namespace rolling
