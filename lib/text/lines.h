// Lines as records, names and comments are: those of a file, but that a quoted field may hold line
// ends.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "text/delimiters.h"
#include "text/input.h"

namespace rolling {

enum class LineKind { blank, comment, history, record };

/// A blank line holds nothing but blanks and tabs; a comment begins with #, a line of history with
/// ##. What begins with an error value of a spreadsheet (#N/A) is a record.
LineKind kind_of(std::string_view line);

class Lines {
 public:
  /// As Input.
  explicit Lines(std::string name, BlockHook on_block = {})
      : input_(std::move(name), std::move(on_block)) {}

  /// Goes to the next line; false at the end. Throws InputError for a quote that does not end.
  bool next() {
    if (std::exchange(again_, false)) return true;
    if (!input_.next(text_)) return false;
    number_ = input_.line_number();
    if (input_.quotes() && !separators_.empty()) join_quoted();
    return true;
  }
  /// From here on only this character separates fields; 0 stands for blanks, where there are no
  /// quoted fields. Without it any separator may.
  void separate_by(char separator) {
    separators_ = separator ? std::string(1, separator) : std::string();
  }
  /// next() comes to the present line once more.
  void put_back() { again_ = true; }
  /// The present line, valid until the next one.
  std::string_view text() const { return text_; }
  std::size_t number() const { return number_; }  ///< of its beginning, from 1
  const std::string& name() const { return input_.name(); }

  /// What of the file is there behind the present line: lines, and perhaps a part of one. Nothing
  /// after put_back().
  std::string_view ahead() const { return again_ ? std::string_view() : input_.ahead(); }
  /// Goes to the line that begins ahead(), which is not quoted, of `size` bytes and `end` ones that
  /// end it.
  void take(std::size_t size, std::size_t end) {
    text_ = ahead().substr(0, size);
    input_.skip(size + end);
    number_ = input_.line_number();
  }

  std::size_t lines_ahead() const { return input_.lines_ahead(); }
  bool another_run() const { return input_.another_run(); }

 private:
  void join_quoted();

  Input input_;
  std::string_view text_;
  std::size_t number_ = 0;
  bool again_ = false;
  std::string joined_, separators_{separators};
};

}  // namespace rolling
