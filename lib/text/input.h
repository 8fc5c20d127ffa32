// SPDX-License-Identifier: GPL-3.0-or-later
// The lines of one input file, which is read in blocks.
#pragma once

#include <string>
#include <string_view>

#include "base/growing.h"

namespace rolling {

/// Bytes. A row of motion data has tens of bytes; a file with longer lines is not one of columns.
inline constexpr std::size_t longest_line = 1 << 20;

/// Throws InputError if standard output is this regular file: the tool would read what it writes,
/// or append its output to its input.
void refuse_output(const std::string& name);

class Input {
 public:
  /// Opens a file; `-` is standard input. Throws Error when it cannot be read.
  explicit Input(std::string name);
  ~Input();
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  /// The next line without its end (LF or CR LF), valid until the next call; false at the end of
  /// the file.
  bool next(std::string_view& line);
  /// The bytes that are in memory behind the present line; they may end within a line.
  std::string_view ahead() const { return {at_, end_}; }
  /// Goes behind the next line, as next() does; it has `size` bytes, the line end included.
  void skip(std::size_t size) {
    at_ += size;
    ++line_number_;
  }

  bool has_size() const { return has_size_; }        ///< it is a regular file, and not empty
  const std::string& name() const { return name_; }  ///< as the user gave it
  std::size_t line_number() const { return line_number_; }

 private:
  bool fill();
  const char* end_of_line();

  std::string name_;
  int fd_;
  bool has_size_;
  Bytes buffer_;
  const char *at_, *end_;  // ahead()
  std::size_t line_number_ = 0;
  bool at_end_ = false;
};

}  // namespace rolling
