// SPDX-License-Identifier: GPL-3.0-or-later
// Logical lines of a file, which is read in blocks: a line end inside a quoted field does not end
// the line.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "text/dialect.h"
#include "text/number.h"

namespace rolling {

enum class LineKind { blank, comment, history, row };

inline bool is_history(std::string_view line) { return line.starts_with("##"); }

/// A `##` line without the quotes and separators that a spreadsheet has put around it, and with
/// blanks where it has separators in their place.
std::string history_line(std::string_view line);

class Lines {
 public:
  /// Opens a file; `-` is standard input. Throws InputError when it cannot be read, and if it is
  /// the standard output too: the tool would read what it writes.
  explicit Lines(std::string name);
  ~Lines();
  Lines(const Lines&) = delete;
  Lines& operator=(const Lines&) = delete;

  /// Goes to the next line, without its end (LF or CR LF); false at the end. Throws InputError for
  /// a line that is too long, a quote that is not closed, and for a NUL or a carriage return within
  /// the line.
  bool next();
  /// From now on only this character separates fields, and a quote opens a field behind it. With 0,
  /// blanks separate and there are no quoted fields. Before this call any separator counts.
  void separate_by(char separator) {
    separators_ = separator ? std::string(1, separator) : std::string();
  }
  /// The next call of next() returns to the present line or, while lines are held, to the first one
  /// of them.
  void put_back() {
    at_ = kept_;
    count_ = kept_count_;
  }
  /// While `on`, lines are held: those from the present one on, which has been put back.
  void hold(bool on) { held_ = on; }
  /// The present line, valid until the next one.
  std::string_view text() const { return text_; }
  /// A blank line contains blanks, tabs and separators only, blank cells in quotes perhaps, or the
  /// Ctrl-Z that ends a file of DOS. A comment begins with #, a history line with ##; blanks may
  /// stand before it, and tabs where they are not the separator. A history line may be in quotes,
  /// if the other fields of its line are blank. A line that begins with an error value of a
  /// spreadsheet (#N/A) is a row.
  LineKind kind() const { return kind_of(text_); }
  std::size_t number() const { return number_; }     ///< of its first line in the file, from 1
  const std::string& name() const { return name_; }  ///< of the file, as the user gave it

  /// The bytes that are in memory from the next line on; they may end within a line.
  std::string_view ahead() const { return {at_, end_}; }
  /// Goes to the line at the beginning of ahead(), which has no quoted line end; its own end (LF or
  /// CR LF) begins here.
  void take_to(const char* end) {
    text_ = {at_, end};
    at_ = end + (*end == '\r' ? 2 : 1);
    number_ = ++count_;
  }

  /// True for a line of words above lines of cells, as `Vernier Format 2`: it begins with no
  /// number, and of the next lines in memory three are divided by a tab, semicolon or comma, as it
  /// is not.
  bool is_title() const;

  /// True for a regular file with a blank line, and a row below it, in memory behind the present
  /// line.
  bool another_run() const;

 private:
  bool next_in_file();
  bool fill();
  void join_quoted();
  void check_bytes() const;
  LineKind kind_of(std::string_view line) const;
  bool is_blank_row(std::string_view line) const;

  std::string name_;
  int fd_;
  bool has_size_ = false;  // a regular file, and not empty
  Bytes buffer_;
  const char* kept_;  // in it: where put_back() returns to
  const char* at_;    // the next line
  const char* end_;
  std::size_t kept_count_ = 0;  // lines of the file before kept_
  std::size_t count_ = 0;       // and before at_
  bool held_ = false;
  bool at_end_ = false;
  std::string_view text_;
  std::size_t number_ = 0;
  std::string joined_;
  std::string separators_{separators};
};

/// The last line of the output of a tool that ends with an error after it has begun to print.
std::string error_line(std::string_view tool);

/// Throws InputError if the present line, which begins with ##, is such a line.
void refuse_error_line(const Lines&);

}  // namespace rolling
