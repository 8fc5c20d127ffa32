// How the lines of a file fall into fields.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rolling {

/// A field without its quotes and the blanks around it.
struct Field {
  std::string_view text{};
  double number =
      std::numeric_limits<double>::quiet_NaN();  ///< if it is wanted; NaN if the text is none
  bool wanted = false;
};

class Dialect {
 public:
  /// Blanks separate, until another form is chosen.
  Dialect() = default;
  /// That of the tools' own output: tabs, and a decimal point.
  static Dialect of_output();

  /// Takes the form from a line: the first of the separators that it has outside quotes, else
  /// blanks. True if it holds a number.
  bool choose(std::string_view line);
  /// A line of the form that has been chosen holds a number.
  bool holds_number(std::string_view line);
  /// The number of this field is wanted, from 0, until the next choice, or until none is.
  void want(std::size_t field);
  void want_none();

  /// The fields of a line, valid until the next call or the line's end. In files delimited by ; or
  /// tab, where they leave no doubt, a decimal comma becomes a point and U+2212 a minus. Throws
  /// Error where two decimal marks meet, where a comma may be a decimal one or one of thousands,
  /// and for a quote that does not end or has text behind it.
  std::span<const Field> split(std::string_view line);
  /// The same for the line that begins `text`, whose end is not known yet, if its fields leave no
  /// doubt where each ends: numbers, or plain text, quoted or not, between separators, up to a line
  /// feed within `text`. Returns the end of the last one; null if there is doubt.
  const char* split_plain(std::string_view text, std::span<const Field>& fields);

  /// The last line was its fields with a tab between them.
  bool as_it_stands() const { return as_it_stands_; }
  /// A field of the last line may need quotes in a tab-separated one.
  bool may_need_quotes() const { return may_need_quotes_; }
  char separator() const { return separator_; }  ///< '\0' for blanks

 private:
  bool foreign() const {
    return foreign_numbers_ && decimal_mark_ != '.';
  }  ///< the next number may still be of another form
  Field& next_field() {
    if (count_ == fields_.size()) fields_.emplace_back();
    return fields_[count_++];
  }
  void split_blanks(const char* at, const char* end);
  const char* take_text(const char* at, const char* end, Field&);
  std::string_view take_quoted(const char*& at, const char* end);
  bool rewrite(Field&);

  char separator_ = '\0';
  bool foreign_numbers_ = false;  // numbers may have decimal commas and U+2212
  char decimal_mark_ = '\0';      // the one seen
  bool as_it_stands_ = false, may_need_quotes_ = false;
  std::vector<Field> fields_;  // room for those of the longest line
  std::size_t count_ = 0;      // of the fields of this line
  std::string made_;  // the texts of fields that do not stand in the line, with room for all
};

}  // namespace rolling
