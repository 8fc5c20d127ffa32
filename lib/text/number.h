// Numbers as text: what may be read, and how they are written.
#pragma once

#include <string>
#include <string_view>

namespace rolling {

/// Reads the whole of `field` as [+-]? (digits [. digits?] | . digits) ([eE] [+-]? digits)?, whatever the locale.
/// False for anything else (inf, nan, hex, blanks) and for what a double cannot hold (1e400, 1e-400).
bool parse_number(std::string_view field, double& value);

inline bool is_number(std::string_view field) {
  double value;
  return parse_number(field, value);
}

/// A missing reading: nothing at all, or NaN in any case.
bool is_missing(std::string_view field);

/// Appends the shortest text that reads back to the same double, or `digits` significant digits when digits > 0.
void append_number(std::string& to, double value, int digits = 0);

/// `text` for a message: printable ASCII only, cut at 40 characters.
std::string shown(std::string_view text);

/// `field` without blanks around it.
std::string_view trim(std::string_view field);

}  // namespace rolling
