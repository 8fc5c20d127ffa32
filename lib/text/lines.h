// Lines as records, names and comments are: those of a file, but that a quoted field may hold line
// ends.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "text/input.h"
#include "text/number.h"

namespace rolling {

inline constexpr char comment_mark = '#', no_mark = '\n';

/// The first character that is not a blank; no_mark, which no line begins with, if there is none.
inline char first_mark(std::string_view line) {
  for (const char c : line)
    if (!is_blank(c)) return c;
  return no_mark;
}

class Lines {
 public:
  /// As Input.
  explicit Lines(std::string name, BlockHook on_block = {})
      : input_(std::move(name), std::move(on_block)) {}

  /// Goes to the next line; false at the end. Throws InputError for a quote that does not end.
  bool next() {
    if (!kept_.empty()) return next_kept();
    if (!input_.next(text_)) return false;
    number_ = input_.line_number();
    if (input_.quotes()) join_quoted();
    return true;
  }
  /// The present line, valid until the next one.
  std::string_view text() const { return text_; }
  std::size_t number() const { return number_; }  ///< of its beginning, from 1
  const std::string& name() const { return input_.name(); }

  /// What of the file is there behind the present line: lines, and perhaps a part of one. Nothing
  /// of lines that are kept.
  std::string_view ahead() const { return input_.ahead(); }
  /// Goes to the line that begins ahead(), which is not quoted, of `size` bytes and `end` ones that
  /// end it.
  void take(std::size_t size, std::size_t end) {
    text_ = ahead().substr(0, size);
    input_.skip(size + end);
    number_ = input_.line_number();
  }

  std::size_t lines_ahead() const { return input_.lines_ahead(); }

  /// Keeps the lines from the present one on, so that they can be read again; stays at it.
  void keep();
  /// Goes back before the first line that is kept.
  void again() { kept_at_ = 0; }

 private:
  void join_quoted();
  bool next_kept();

  Input input_;
  std::string_view text_;
  std::size_t number_ = 0;
  std::string joined_;
  struct Kept {
    std::size_t number;
    std::string text;
  };
  std::vector<Kept> kept_;
  std::size_t kept_at_ = 0;
};

}  // namespace rolling
