// SPDX-License-Identifier: GPL-3.0-or-later
// The separators of fields, quoted fields, and the fields of a line.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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

/// The place of the quote that closes a field, in the text behind its opening quote; the size of
/// the text if there is none. Two quotes in a row stand for one quote inside the field.
std::size_t closing_quote(std::string_view text);

/// Takes a quoted field from the beginning of `line`, and the blanks behind it; with `separator` 0
/// a blank ends it. Returns its text without blanks around it, with one quote for two; nothing if
/// there is none, if no quote closes it, or if other text stands behind that quote.
std::optional<std::string> take_quoted(std::string_view& line, char separator);

/// The part of a text that is outside quoted fields. A quote opens such a field only where a field
/// begins: at the beginning of the text and behind one of these separators. `within`: whether the
/// text begins within a quoted field; afterwards, whether it ends within one.
std::string outside_quotes(std::string_view text, std::string_view separators, bool& within);

/// The text in quotes, with two quotes for each one in it.
std::string quoted(std::string_view text);

/// Appends a field to a tab-separated line, in quotes if it contains a tab, a line end or a quote,
/// or begins with #.
void append_field(Bytes& line, std::string_view field);

/// A field without its quotes and the blanks around it.
struct Field {
  std::string_view text{};
  /// The number, if it is wanted; NaN if the text is not a number.
  double number = std::numeric_limits<double>::quiet_NaN();
  bool wanted = false;  ///< the number of this field is needed
};

/// Blanks separate fields until choose() finds another separator.
class Dialect {
 public:
  /// Chooses the separator from a line: the first of the separators that the line contains outside
  /// quotes, else blanks; also if blanks and tabs both separate numbers, unless `tabs` says that
  /// tabs separate the names. True if the line contains a number or NaN.
  bool choose(std::string_view line, bool tabs = false);
  /// True if a line, split by the chosen separator, contains a number or NaN.
  bool holds_number(std::string_view line);
  /// From now on the number of this field (counted from 0) is read, until the next choose() or
  /// want_none().
  void want(std::size_t field);
  void want_none() { fields_.assign(fields_.size(), {}); }
  /// A point is a decimal one in this file, whose head a tool has written.
  void has_points() { asks_ = false; }

  /// The fields of a line, valid until the next call or as long as the line. In files delimited by
  /// ; or tab a decimal comma becomes a point, and the minus sign U+2212 a hyphen. Throws Error for
  /// a file with both decimal marks, for a mark that may separate thousands (1,002 and, below 980,
  /// 1.000), and for a quote that is not closed or has text behind it.
  std::span<const Field> split(std::string_view line);
  /// Fast path of split() for the line at the beginning of `text`, whose end has not been searched
  /// for: each field is a number, or text without special characters, quoted or not, and the line
  /// feed is within `text`. Returns the end of the line; null for any other line, which is left to
  /// split().
  const char* split_plain(std::string_view text, std::span<const Field>& fields);

  char separator() const { return separator_; }  ///< '\0' for blanks

 private:
  /// The separator allows decimal commas, and the minus sign U+2212.
  bool allows_foreign() const { return separator_ == '\t' || separator_ == ';'; }
  const char* split_with_commas(std::string_view text, std::span<const Field>& fields);
  const char* split_with_points(std::string_view text, std::span<const Field>& fields);
  const char* take_text(const char* at, const char* end, Field&);
  bool rewrite(Field&);
  bool may_be_grouped(const Field&);

  /// Readings of a column that speak for a point between thousands, while no number has shown that
  /// it is a decimal one.
  struct Seen {
    bool whole = false;            // 0 to 999
    bool three_digits = false;     // 100 to 999
    bool grouped = false;          // 1.000
    bool zero_at_the_end = false;  // 1.100: no shortest number ends so
  };

  char separator_ = '\0';
  char decimal_mark_ = '\0';       // of the numbers so far; '\0' if none had one
  bool asks_ = true;               // a point may separate thousands, if a comma may be decimal
  bool passed_thousands_ = false;  // a number has passed whose mark may separate thousands
  std::vector<Seen> seen_;         // by field
  std::vector<Field> fields_;      // as many as the longest line had
  std::size_t count_ = 0;          // fields of this line
  // The texts of fields that were rewritten. Fields point into it, so it may not be reallocated.
  std::string made_;
};

}  // namespace rolling
