// Standard output, whole lines at a time, every write checked.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "text/column.h"
#include "text/number.h"

namespace rolling {

/// Standard output does not take it: no record is to blame.
class OutputError : public Error {
 public:
  using Error::Error;
};

class Output {
 public:
  int digits = 0;           ///< significant digits of computed numbers; 0: the shortest text that reads back
  bool unbuffered = false;  ///< every line goes out at once
  std::function<void()> before_write;

  // The line in the making.
  void text(std::string_view text) { to_ = std::copy(text.begin(), text.end(), room(text.size())); }
  void text(char c) { *room(1) = c, ++to_; }
  /// Throws Error for a number that is not finite.
  void number(double value) {
    if (!std::isfinite(value)) fail("the result is not a finite number");
    to_ = write_number(room(longest_number), value, digits);
  }
  /// The next cell of a tab-separated row.
  void cell(double value);
  void blank() { separate(); }  ///< the next cell, missing
  void end_line() {
    text('\n');
    whole_ = size();
    cells_ = 0;
    if (unbuffered || whole_ >= block) flush();
  }
  void names(const std::vector<Column>&);    ///< the names line
  void row(std::span<const double> values);  ///< cells and the line's end
  /// Writes what is there. Throws OutputError when the system does not take it.
  void flush();
  /// Forgets a line in the making.
  void drop_line() {
    to_ = buffer_.get() + whole_;
    cells_ = 0;
  }

 private:
  char* room(std::size_t count) {
    if (static_cast<std::size_t>(limit_ - to_) < count) grow(count);
    return to_;
  }
  void grow(std::size_t count);
  std::size_t size() const { return static_cast<std::size_t>(to_ - buffer_.get()); }
  void separate() {
    if (cells_++ > 0) text('\t');
  }

  static constexpr std::size_t block = 1 << 16;
  std::unique_ptr<char[]> buffer_;
  char *to_ = nullptr, *limit_ = nullptr;  // where the next byte goes; the buffer's end
  std::size_t cells_ = 0;  // of the line in the making
  std::size_t whole_ = 0;  // bytes of whole lines
};

}  // namespace rolling
