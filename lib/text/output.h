// Standard output, whole lines at a time, every write checked.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "text/column.h"
#include "text/number.h"

namespace rolling {

class Output {
 public:
  int digits = 0;           ///< significant digits of computed numbers; 0: the shortest text that reads back
  bool unbuffered = false;  ///< every line goes out at once

  std::string& line() { return buffer_; }  ///< what is appended here is the line in the making
  void number(double value) { append_number(buffer_, value, digits); }
  void end_line() {
    buffer_ += '\n';
    whole_ = buffer_.size();
    if (unbuffered || buffer_.size() >= block) flush();
  }
  /// The names line, and a row of computed numbers. Throws Error for a number that is not finite.
  void names(const std::vector<Column>&);
  void row(std::span<const double>);
  /// Writes what is there. Throws Error when the system does not take it.
  void flush();
  /// Forgets a line in the making.
  void drop_line() { buffer_.resize(whole_); }

 private:
  static constexpr std::size_t block = 1 << 16;
  std::string buffer_;
  std::size_t whole_ = 0;  // bytes of whole lines in it
};

}  // namespace rolling
