// SPDX-License-Identifier: GPL-3.0-or-later
// Standard output, written in whole lines; every write is checked.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "text/column.h"
#include "text/dialect.h"
#include "text/number.h"

namespace rolling {

/// The header: `# t[s]<TAB>v[m/s]`.
std::string names_line(const std::vector<Column>&);

inline void require_finite(double value) {
  if (!std::isfinite(value)) fail("the result is not a finite number");
}

class Output {
 public:
  int digits = 0;  ///< significant digits of computed numbers; 0: the shortest text that reads back
  bool unbuffered = false;  ///< each line is written at once
  /// One table for other programs: the header once and without `# `, no other line that begins with
  /// # and none that is empty, and the run that a line `## run NAME` names in a last column.
  bool plain = false;

  // These append to the current line.
  void text(std::string_view text) { buffer_.append(text); }
  void text(char c) { buffer_.push_back(c); }
  /// Throws Error for a number that is not finite.
  void number(double value) {
    require_finite(value);
    append_number(buffer_, value, digits);
  }
  /// Appends the next cell of a tab-separated row.
  void cell(double value) {
    separate();
    number(value);
  }
  void cell(std::string_view text) {  ///< empty for a missing number
    separate();
    append_field(buffer_, text);
  }
  void end_line() {
    if (plain && !end_plain_line()) return;
    text('\n');
    whole_ = buffer_.size();
    cells_ = 0;
    if (unbuffered || whole_ >= block) flush();
  }
  /// Appends this text and ends the line.
  void line(std::string_view whole) {
    text(whole);
    end_line();
  }
  void names(const std::vector<Column>& columns) { header(names_line(columns)); }
  /// Writes a names_line(). With `plain`, throws Error if it is not that of the run before.
  void header(const std::string& line);
  /// Writes the line `## run NAME` that is among these, if one is.
  void run_among(const std::vector<std::string>& comments);
  /// Writes the buffer. Throws CompleteError if the system reports an error: ReaderGone if the
  /// output is a pipe that nobody reads, where SIGPIPE is ignored.
  void flush();
  /// Removes the current line and writes this one as the last of the output, if there has been any
  /// output and the system accepts it. Never throws.
  void end_with(std::string_view line) noexcept;
  bool has_printed() const { return written_; }  ///< something has been written
  /// Removes the current line.
  void drop_line() {
    buffer_.resize(whole_);
    cells_ = 0;
  }

 private:
  void separate() {
    if (cells_++ > 0) text('\t');
  }
  bool end_plain_line();

  static constexpr std::size_t block = 1 << 16;
  Bytes buffer_;
  std::size_t cells_ = 0;  // cells of the current line
  std::size_t whole_ = 0;  // bytes of the complete lines
  bool written_ = false;   // something has been written
  bool torn_ = false;      // the last write ended within a line
  // With `plain`:
  std::string header_;
  std::string run_;
  bool with_run_ = false;  // the table has a column for the run
};

}  // namespace rolling
