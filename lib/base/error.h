// SPDX-License-Identifier: GPL-3.0-or-later
// The exception type of the library. Its message is one line for the user. Tool::run() catches it.
#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <string>

namespace rolling {

/// What an error is about: by this the tools add a place or a way out to its message.
enum ErrorKind {
  PlainError,     ///< the present row of the input, if there is one
  CompleteError,  ///< the message is complete: no row is to be named beside it
  ReaderGone,     ///< complete: nobody reads the output any more
  InputError,     ///< complete: it names the file, and the line where there is one
  OptionError,    ///< complete: it is one of the options, whatever has been read
  // Numeric code knows no option: it throws what the readings show, and cli/tool.cpp has the way
  // out.
  ReadingOff,  ///< one of the readings is off the motion of the others
  // The readings show no motion of the kind that is asked for: perhaps the columns are not those
  // that are meant.
  MotionError,
  NotOneRoll,     ///< they are hardly those of one roll: no law comes out
  OneWay,         ///< they go one way, where a slope or a wind acts as the law does
  LooseExponent,  ///< they do not determine the exponent
  NoFreeRoll,     ///< there is no roll among them
  WayBack         ///< they are of a body that comes back
};

struct Error : std::runtime_error {
  Error(ErrorKind of, const std::string& text) : std::runtime_error(text), kind(of) {}
  bool is_complete() const { return kind >= CompleteError && kind <= OptionError; }
  bool is_of_motion() const { return kind >= MotionError; }

  ErrorKind kind;
};

/// Throws an error of this kind, with a formatted message.
template <ErrorKind kind = PlainError, typename... Args>
[[noreturn]] void fail(fmt::format_string<Args...> text, const Args&... args) {
  throw Error(kind, fmt::vformat(text, fmt::make_format_args(args...)));
}

/// What `work` returns. An Error that names no file becomes an InputError at this place, a text
/// that `place` returns.
template <typename Place, typename Work>
auto located(const Place& place, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (error.kind == InputError) throw;
    fail<InputError>("{}: {}", place(), error.what());
  }
}

}  // namespace rolling
