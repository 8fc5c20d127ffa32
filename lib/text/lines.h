// SPDX-License-Identifier: GPL-3.0-or-later
// Logical lines of a file: a line end inside a quoted field does not end the line.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "text/delimiters.h"
#include "text/input.h"

namespace rolling {

enum class LineKind { blank, comment, history, row };

/// A `##` line without the quotes and separators that a spreadsheet has put around it, and with
/// blanks where it has separators in their place.
std::string history_line(std::string_view line);

class Lines {
 public:
  /// Opens the file, see Input.
  explicit Lines(std::string name) : input_(std::move(name)) {}

  /// Goes to the next line; false at the end. Throws InputError for a quote that is not closed, and
  /// for a NUL or a carriage return within the line.
  bool next() {
    if (std::exchange(again_, false)) return true;
    if (!input_.next(text_)) return false;
    number_ = input_.line_number();
    if (!separators_.empty()) join_quoted();
    check_bytes();
    return true;
  }
  /// From now on only this character separates fields, and a quote opens a field behind it. With 0,
  /// blanks separate and there are no quoted fields. Before this call any separator counts.
  void separate_by(char separator) {
    separators_ = separator ? std::string(1, separator) : std::string();
  }
  /// The next call of next() returns to the present line.
  void put_back() { again_ = true; }
  /// The present line, valid until the next one.
  std::string_view text() const { return text_; }
  /// A blank line contains blanks, tabs and separators only, blank cells in quotes perhaps, or the
  /// Ctrl-Z that ends a file of DOS. A comment begins with #, a history line with ##; blanks may
  /// stand before it, and tabs where they are not the separator. A history line may be in quotes,
  /// if the other fields of its line are blank. A line that begins with an error value of a
  /// spreadsheet (#N/A) is a row.
  LineKind kind() const { return kind_of(text_); }
  std::size_t number() const { return number_; }  ///< of its first line in the file, from 1
  const std::string& name() const { return input_.name(); }

  /// The bytes that are in memory behind the present line; they may end within a line. Empty after
  /// put_back().
  std::string_view ahead() const { return again_ ? std::string_view() : input_.ahead(); }
  /// Goes to the line at the beginning of ahead(), which has no quoted line end: `size` bytes, and
  /// `end` bytes of its line end.
  void take(std::size_t size, std::size_t end) {
    text_ = ahead().substr(0, size);
    input_.skip(size + end);
    number_ = input_.line_number();
  }

  /// True for a regular file with a blank line, and a row below it, in memory behind the present
  /// line.
  bool another_run() const;

 private:
  void join_quoted();
  void check_bytes() const;
  LineKind kind_of(std::string_view line) const;
  bool is_blank_row(std::string_view line) const;

  Input input_;
  std::string_view text_;
  std::size_t number_ = 0;
  bool again_ = false;
  std::string joined_, separators_{separators};
};

/// The last line of the output of a tool that ends with an error after it has begun to print.
std::string error_line(std::string_view tool);

/// Throws InputError if the present line, which begins with ##, is such a line.
void refuse_error_line(const Lines&);

}  // namespace rolling
