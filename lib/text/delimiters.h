// What separates fields, and what quotes them.
#pragma once

#include <string>
#include <string_view>

#include "text/bytes.h"

namespace rolling {

/// What may separate the fields of a delimited file, in the order in which a line is searched for
/// them.
inline constexpr std::string_view separators = "\t;,";
constexpr bool is_separator(char c) { return separators.find(c) != std::string_view::npos; }

inline constexpr char quote = '"';

/// The quote that closes a field, from behind its opening one; `end` if there is none. Two quotes
/// in a row stand for one inside the field.
const char* closing_quote(const char* at, const char* end);

/// What of `text` stands outside quoted fields. A quote opens where a field begins: behind one of
/// these separators, and at the beginning if `field_begins`.
struct Unquoted {
  std::string text;
  bool ends_within = false;  ///< a quoted field is still open at the end
};
Unquoted outside_quotes(std::string_view text, std::string_view between, bool field_begins = true);

/// A field cannot stand bare in a tab-separated line, whatever precedes it: it holds a tab, a line
/// end or a quote, or begins with a comment's mark.
bool needs_quotes(std::string_view field);

/// Appends a field to a tab-separated line, quoted where it has to be.
void append_field(Bytes& line, std::string_view field);

}  // namespace rolling
