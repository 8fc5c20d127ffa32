// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as text, with an uncertainty (0.50+-0.005) or without: reading and writing.
#pragma once

#include <fmt/format.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "base/estimate.h"

namespace rolling {

/// Reads the whole of `field` as [+-]? (digits [. digits?] | . digits) ([eE] [+-]? digits)?,
/// independent of the locale. Returns false for any other text (inf, nan, hexadecimal numbers,
/// blanks) and for numbers beyond the range of a double (1e400, 1e-400).
bool parse_number(std::string_view field, double& value);

/// Reads a number at the beginning of [at, end) and returns its end. If there is no number it
/// returns `at` and leaves `value` unchanged.
const char* read_number(const char* at, const char* end, double& value);

inline bool is_number(std::string_view field) {
  double value;
  return parse_number(field, value);
}

inline constexpr std::string_view decimal_digits = "0123456789";

/// True for digits and nothing else.
inline bool is_whole(std::string_view text) {
  return !text.empty() && text.find_first_not_of(decimal_digits) == std::string_view::npos;
}

/// True for a missing reading: an empty field, or NaN in upper or lower case.
bool is_missing(std::string_view field);

/// Text that grows at its end.
using Bytes = fmt::memory_buffer;

/// Appends the shortest text that reads back to the same double and, of several that short, the one
/// closest to it, in the form of fmt's "{}": 0.001, 1.5, 1e-04, 1e+16. Or `digits` significant
/// digits, if digits > 0 and they are not beyond the largest double. The value is finite.
void append_number(Bytes& to, double value, int digits = 0);

/// `text` as a message shows it: printable ASCII only, at most 40 characters.
std::string shown(std::string_view text);

/// In small letters.
std::string lower(std::string_view text);

/// The text, in which the second text of a pair replaces each occurrence of the first; where two
/// pairs begin at a place, the one that is listed first.
std::string replace_all(std::string_view text,
                        std::initializer_list<std::pair<std::string_view, std::string_view>>);

/// With a plain blank for each no-break or thin one (U+00A0, U+2009, U+202F).
std::string with_plain_blanks(std::string_view text);

inline bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// `field` without blanks around it.
inline std::string_view trim(std::string_view field) {
  while (!field.empty() && is_blank(field.front())) field.remove_prefix(1);
  while (!field.empty() && is_blank(field.back())) field.remove_suffix(1);
  return field;
}

/// Reads the whole of `text`: a number, or a number, `+-` and the standard uncertainty, which has
/// no sign. `+/-` and the sign of one character are read as well, and blanks may stand around. Both
/// numbers have the syntax of number.h. Returns false for any other text and then leaves `estimate`
/// unchanged.
bool parse_estimate(std::string_view text, Estimate& estimate);

/// The shortest text that reads back to the same numbers: `0.5+-0.005`, or `0.5` if sigma is 0.
std::string to_text(const Estimate&);

}  // namespace rolling
