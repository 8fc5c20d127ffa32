// Numbers as text: what may be read, and how they are written.
#pragma once

#include <string>
#include <string_view>

namespace rolling {

/// Reads the whole of `field` as [+-]? (digits [. digits?] | . digits) ([eE] [+-]? digits)?,
/// whatever the locale. False for anything else (inf, nan, hex, blanks) and for what a double
/// cannot hold (1e400, 1e-400).
bool parse_number(std::string_view field, double& value);

/// The same at the beginning of [at, end): returns where the number ends; `at`, and the value as it
/// was, where there is none.
const char* read_number(const char* at, const char* end, double& value);

inline bool is_number(std::string_view field) {
  double value;
  return parse_number(field, value);
}

/// A missing reading: nothing at all, or NaN in any case.
bool is_missing(std::string_view field);

/// Writes the shortest text that reads back to the same double, or `digits` significant digits when
/// digits > 0; returns its end, which is at most longest_number behind `to`.
char* write_number(char* to, double value, int digits = 0);
inline constexpr std::size_t longest_number = 32;

/// `text` for a message: printable ASCII only, cut at 40 characters.
std::string shown(std::string_view text);

inline bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// `field` without blanks around it.
inline std::string_view trim(std::string_view field) {
  while (!field.empty() && is_blank(field.front())) field.remove_prefix(1);
  while (!field.empty() && is_blank(field.back())) field.remove_suffix(1);
  return field;
}

}  // namespace rolling
