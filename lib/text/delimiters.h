// SPDX-License-Identifier: GPL-3.0-or-later
// The separators of fields, and quoted fields.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "text/number.h"

namespace rolling {

/// What stands around cells where they are blank: the separators and the blank. It is an array,
/// since two uses of a literal may be two objects, and a search goes from the begin of one to its
/// end.
inline constexpr char filling_characters[] = "\t;, ";
inline constexpr std::string_view filling = filling_characters;
/// The separators of delimited files. A line is searched for them in this order.
inline constexpr std::string_view separators = filling.substr(0, 3);
constexpr bool is_separator(char c) { return separators.find(c) != std::string_view::npos; }

inline constexpr char quote = '"';

/// Finds the quote that closes a field; `at` is behind the opening quote. Returns `end` if there is
/// none. Two quotes in a row stand for one quote inside the field.
const char* closing_quote(const char* at, const char* end);

/// Takes a quoted field from the beginning of `line`, and the blanks behind it; with `separator` 0
/// a blank ends it. Returns its text without blanks around it, with one quote for two; nothing if
/// there is none, if no quote closes it, or if other text stands behind that quote.
std::optional<std::string> take_quoted(std::string_view& line, char separator);

/// The part of a text that is outside quoted fields.
struct Unquoted {
  std::string text;
  bool ends_within = false;  ///< a quoted field is still open at the end
};
/// A quote opens a quoted field only where a field begins: at the beginning of `text`, which may be
/// within such a field already, and behind one of these separators.
Unquoted outside_quotes(std::string_view text, std::string_view separators, bool within = false);

/// True for a field that must be quoted in a tab-separated line: it contains a tab, a line end or a
/// quote, or begins with #.
bool needs_quotes(std::string_view field);

/// Appends a field to a tab-separated line, in quotes if it needs them.
void append_field(Bytes& line, std::string_view field);

}  // namespace rolling
