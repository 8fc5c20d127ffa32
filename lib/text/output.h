// Standard output, whole lines at a time, every write checked.
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "text/bytes.h"
#include "text/column.h"
#include "text/delimiters.h"
#include "text/number.h"

namespace rolling {

/// Standard output does not take it: no record is to blame.
class OutputError : public Error {
 public:
  using Error::Error;
};

/// The names as they go out: `# t[s]<TAB>v[m/s]`.
std::string names_line(const std::vector<Column>&);

inline void require_finite(double value) {
  if (!std::isfinite(value)) fail("the result is not a finite number");
}

class Output {
 public:
  int digits = 0;  ///< significant digits of computed numbers; 0: the shortest text that reads back
  bool unbuffered = false;  ///< every line goes out at once
  std::function<void()> before_write;

  // The line in the making.
  void text(std::string_view text) { buffer_.append(text); }
  void text(char c) { buffer_.append(c); }
  /// Throws Error for a number that is not finite.
  void number(double value) {
    require_finite(value);
    buffer_.end(write_number(buffer_.room(longest_number), value, digits));
  }
  /// The next cell of a tab-separated row.
  void cell(double value) {
    separate();
    number(value);
  }
  void blank() { separate(); }  ///< the next cell, missing
  void cell(std::string_view text) {
    separate();
    append_field(buffer_, text);
  }
  void end_line() {
    text('\n');
    whole_ = buffer_.size();
    cells_ = 0;
    if (unbuffered || whole_ >= block) flush();
  }
  void names(const std::vector<Column>&);    ///< the names line
  void row(std::span<const double> values);  ///< cells and the line's end
  /// Writes what is there. Throws OutputError when the system does not take it.
  void flush();
  /// Ends what has been printed with this line, as far as the system still takes it; nothing where
  /// nothing has been printed. Forgets a line in the making. Never throws.
  void end_with(std::string_view line) noexcept;
  bool has_printed() const { return written_; }  ///< whether anything has gone out
  /// Forgets a line in the making.
  void drop_line() {
    buffer_.cut(whole_);
    cells_ = 0;
  }

 private:
  void separate() {
    if (cells_++ > 0) text('\t');
  }

  static constexpr std::size_t block = 1 << 16;
  Bytes buffer_;
  std::size_t cells_ = 0;  // of the line in the making
  std::size_t whole_ = 0;  // bytes of whole lines
  bool written_ = false;   // something has gone out
  bool torn_ = false;      // and not up to the end of a line
};

}  // namespace rolling
