// How the lines of a file fall into fields.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rolling {

class Dialect {
 public:
  /// Takes the form from a line: the first of tab ; , that it has outside quotes, else blanks. True if it holds a number.
  bool choose(std::string_view line);

  /// The fields of a line, without quotes and the blanks around them. Valid until the next call or the line's end.
  /// In files delimited by ; or tab, where they leave no doubt, a decimal comma becomes a point and U+2212 a minus.
  /// Throws Error where two decimal marks meet.
  std::vector<std::string_view>& split(std::string_view line);

  /// The last line was its fields with a tab between them, blanks around them aside.
  bool tabs_only() const { return separator_ == '\t' && !changed_; }
  char separator() const { return separator_; }  ///< '\0' for blanks

 private:
  void split_blanks(std::string_view line);
  void split_quoted(std::string_view line);
  void rewrite_numbers();

  char separator_ = '\0';
  bool foreign_numbers_ = false;  // numbers may have decimal commas and U+2212
  char decimal_mark_ = '\0';      // the one seen
  bool changed_ = false;          // the last line had quotes or numbers to rewrite
  std::vector<std::string_view> fields_;
  std::vector<std::string> unquoted_, rewritten_;
};

}  // namespace rolling
