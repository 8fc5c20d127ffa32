// SPDX-License-Identifier: GPL-3.0-or-later
// The input and the output of a tool that adds computed numbers to each row, or replaces a
// column. A row is kept as text until its numbers have been computed, which may be later (a
// window that looks ahead). Every byte that is not computed is written as it was read. Each run is
// written with its own head: its name, comments and history, the line of this tool, the names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <queue>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "text/number.h"
#include "text/output.h"
#include "text/reader.h"

namespace rolling {

/// The `##` line of a tool if --use gives another column the name that earlier lines contain.
inline constexpr std::string_view columns_renamed = "columns renamed";

class RowPipe {
 public:
  /// `history` is the `##` line, without the marks, that says what this tool does; empty if it
  /// changes no number.
  RowPipe(Reader& in, Output& out, std::string history);
  RowPipe(const RowPipe&) = delete;
  RowPipe& operator=(const RowPipe&) = delete;
  /// Another line than that of the runs before. For the present run before the first of its
  /// numbers.
  void set_history(const std::string& line) { history_ = "## " + line; }
  /// What the error says behind "no rows are left".
  void say_why_none(std::function<std::string()> why) { why_none_ = std::move(why); }

  /// The numbers replace the column of this slot of the reader.
  void replace(std::size_t slot) { replaced_ = slot; }
  /// The numbers form a new last column. With several new columns each row needs one number for
  /// each, in their order. An existing column of that name is renamed `name_in`.
  void append(Column column) { appended_.push_back(std::move(column)); }

  /// Goes to the next run or row, as Reader does. The row waits for its numbers.
  bool next_run();
  bool next();
  /// Of rows of one time that are joined: the number of the first, or the mean of the column that
  /// is replaced.
  double operator[](std::size_t slot) const {
    if (!joined_time_) return in_[slot];
    return slot == replaced_ ? joined_value_ : *joined_time_;
  }
  /// The row with the index i in this run (from 0) begins a run of its own in the output, of this
  /// name. The rows before it have been dropped or wait for numbers; it has not been written.
  void split(std::size_t i, const std::string& name);
  /// Gives the next number to the oldest row that lacks one. Throws Error if it is not finite.
  void put(double value) {
    require_finite(value);
    numbers_.push_back(value);
    if (numbers_.size() >= appended_.size()) write_rows();
  }
  void put(std::span<const double> values) {
    for (const double value : values) put(value);
  }
  /// Leaves out the row with the index i in this run (from 0), which must come after those left
  /// out before. It needs no numbers.
  void drop(std::size_t i);

 private:
  enum class Kind : std::uint8_t { row, comment, names };
  /// A line that waits to be written. Many may wait (smooth --coast): they are kept small. No line
  /// is as long as 2^32.
  struct Line {
    std::uint32_t size;   // of its text
    std::uint32_t place;  // in it, of the numbers of a row
    Kind kind;
  };

  bool next_row();
  void join_rows();
  std::vector<Column> columns() const;
  void hold(std::string_view text, Kind);
  void take_comments(const std::vector<std::string>&);
  void write_rows();
  void begin_part();
  void write_head();
  void write_comments();

  Reader& in_;
  Output& out_;
  std::string history_;  // lines
  std::vector<Column> appended_;
  std::size_t replaced_ = Reader::no_column;  // a slot
  std::size_t cut_ = Reader::no_column;       // its column in this run
  std::deque<Line> lines_;                    // that are not written yet
  Bytes texts_;                               // of these, one after the other
  std::size_t front_ = 0;                     // where the text of the first begins
  std::queue<std::size_t> dropped_;           // indices of the rows among them to leave out
  std::queue<std::pair<std::size_t, std::string>> splits_;  // rows that begin a run, its name
  std::vector<double> numbers_;                             // of the first of these rows
  // Counts of the rows of all runs:
  std::size_t read_ = 0;
  std::size_t run_begins_ = 0;  // read before this run
  std::size_t done_ = 0;        // written or left out
  // The head of a run.
  std::vector<std::string> comments_;  // that are not written yet
  std::string names_;
  bool head_waits_ = false;                  // none of its rows has been written
  std::vector<std::string> history_of_run_;  // what its parts share
  std::optional<double> joined_time_;        // of rows that have become one
  double joined_value_ = 0;                  // of the column that is replaced
  bool ahead_ = false;                       // the row behind the joined ones has been read
  bool any_row_ = false;
  std::function<std::string()> why_none_;
};

}  // namespace rolling
