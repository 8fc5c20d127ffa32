// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the rows of files in the format of rolling-columns(5): finds the needed columns by the
// names in each head, converts them to SI units, and passes all other text through.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "text/clock.h"
#include "text/dialect.h"
#include "text/head.h"
#include "text/lines.h"
#include "text/needed_columns.h"

namespace rolling {

/// Rows of one time are refused, or become one row (see RowPipe): the first, or the mean.
enum class EqualTimes { refused, first, mean };

struct ReaderOptions {
  std::vector<std::string> files = {};  ///< operands, in order; empty for standard input
  std::vector<std::string> use = {};    ///< NAME=COLUMN, or NAME=COLUMN[UNIT]
  std::string run = {};                 ///< the only run to be read; empty for all
  bool strict = false;                  ///< a missing reading is an error
  bool has_use = true;                  ///< the option --use applies to these files
  EqualTimes equal_times = {};          ///< what becomes of rows of one time
};

class Reader {
 public:
  /// Reads up to the first row of the first run, to be read or not. `order` names the columns of a
  /// file without names, up to the first column that --use assigns to another place.
  Reader(ReaderOptions, std::vector<std::string> order);
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  // The head of the present run; before next_run(), of the first run.
  /// Its columns, with the names and units of the output.
  const std::vector<Column>& columns() const { return needed_.in_output(); }
  /// Index of the column that serves as `name` (a name, a 1-based number, or what --use says), if
  /// there is one.
  std::optional<std::size_t> find(std::string_view name) const;
  /// Its comments in the output; the history and the line `## run NAME` are among them.
  const std::vector<std::string>& comments() const { return comments_; }
  /// The `##` lines of this run, without the marks.
  const std::vector<std::string>& history() const { return head_.history; }
  /// The name in a line `## run NAME`; else the base name of its file, followed by its label
  /// (Layout::Run), or by its number in a file of several runs.
  std::string run_name() const;

  /// Declares that a column is needed: its numbers are read and converted to SI, and rows
  /// without one are left out. Times must increase within a run. Returns its slot for operator[].
  /// Throws Error if the column does not exist, in this run or in a later one.
  std::size_t need(std::string_view name) { return add(name, NeededColumns::Kind::needed); }
  /// The same for a column with missing readings, which are NaN. It may be absent from later runs.
  std::size_t want(std::string_view name) { return add(name, NeededColumns::Kind::wanted); }
  /// A column to compare with, if there is one that can be read; NaN where it cannot.
  std::optional<std::size_t> want_beside(std::string_view name) {
    if (!needed_.find_beside(name)) return {};
    return add(name, NeededColumns::Kind::beside);
  }
  /// The same for a column in this SI unit whose name means something else than the known quantity
  /// (a is the coefficient in a row of fitpower, not an acceleration). Without a unit it is in this
  /// one.
  std::size_t need_as_is(std::string_view name, std::string_view unit = {}) {
    return add(name, NeededColumns::Kind::as_is, unit);
  }
  /// The index of a needed column in the rows of the present run.
  std::size_t column_of(std::size_t slot) const { return needed_.all()[slot].column; }
  /// A needed column of this run has another name in the file: what the history says of the name
  /// that it serves under is not about it.
  bool renames() const { return needed_.renames(); }

  // The rows.
  /// Goes to the next run that is to be read; false when there is none. One that is passed over is
  /// read as strictly.
  bool next_run();
  /// Goes to the next row of this run; false at its end.
  bool next();
  /// The number in a needed column [SI].
  double operator[](std::size_t slot) const { return values_[slot]; }
  EqualTimes equal_times() const { return options_.equal_times; }
  /// The time of the present row, if one is needed.
  double time() const { return last_time_; }
  /// The text of a column of the present row.
  std::string_view text(std::size_t column) const { return fields_[column].text; }

  static constexpr std::size_t no_column = NeededColumns::no_column;
  /// Appends the present row as it goes out, tab-separated, without the text of a column;
  /// returns where in it that column stands, or its length if there is none.
  std::size_t append_text(Bytes& to, std::size_t column = no_column);
  /// The comments between the previous row and the present one; after the last row of a run,
  /// those up to the end of the run.
  const std::vector<std::string>& remarks() const { return remarks_; }

  /// `file:line` of the present row. Behind the last row of a run, what its refusal begins
  /// with: `run NAME`, or the file where there is one run. Empty before the first row of a file,
  /// and when next_run() has found no other run.
  std::string where() const;
  /// Number of rows that were left out because a needed reading was missing.
  std::size_t left_out() const { return left_out_; }
  /// What was assumed of columns so far (see NeededColumns).
  const std::string& assumed() const { return needed_.assumed(); }
  /// What to tell of the input at its end: what was assumed of columns (see NeededColumns), and
  /// times so large that the step between two rows loses digits, or that they are hardly in s.
  std::vector<std::string> warnings() const;

 private:
  enum class State { found, in_run, between };

  std::size_t add(std::string_view name, NeededColumns::Kind, std::string_view unit = {});
  void read_needed();
  const Layout::Run& layout() const { return head_.layout.runs[side_]; }

  // Runs.
  bool find_run();
  bool next_head();
  std::string called() const;
  bool asked_for();
  void begin_run();
  bool one_of_several() const;
  bool run_is_named() const;
  std::string of_head() const;

  // Rows.
  bool next_line();
  bool are_names(std::string_view comment) const;
  bool take_fields();
  bool take_row();
  double read(const NeededColumns::Needed&);
  double read_text(const NeededColumns::Needed&);
  void check_time(const NeededColumns::Needed&, double t);
  void note_jump(const NeededColumns::Needed&, double t);
  [[noreturn]] void refuse(const NeededColumns::Needed&, std::string_view why) const;
  std::string here() const;

  ReaderOptions options_;
  NeededColumns needed_;
  std::vector<std::string> order_;
  std::optional<Lines> lines_;
  std::size_t next_file_ = 0;

  // The run.
  State state_ = State::between;
  int run_ = 0;  // number of the run in the input, from 1
  Head head_;
  std::size_t side_ = 0;
  std::size_t blank_rows_ = 0;  // side by side, since the last row of this run
  Dialect dialect_;
  std::vector<std::string> comments_;
  std::vector<std::string> remarks_;
  std::size_t run_in_file_ = 0;  // number of the run in the file
  std::string place_;            // where() behind its last row
  std::string runs_;             // what the runs so far are called, where one is asked for
  bool run_found_ = false;
  bool row_found_ = false;
  bool file_open_ = false;

  // The present row.
  std::vector<double> values_;  // of the needed columns, by slot
  std::span<const Field> fields_;
  std::vector<Field> changed_fields_;
  bool large_time_ = false;
  std::size_t time_slot_ = no_column;
  Clock clock_;                  // of this run
  bool reads_clock_ = false;     // its times are read by it
  double last_time_ = 0;         // NaN before the first row of a run
  double last_step_ = 0;         // NaN before the second
  std::string jump_;             // of times that may be digits of a clock
  std::size_t equal_times_ = 0;  // rows that have the time of the row before
  std::size_t left_out_ = 0;
};

}  // namespace rolling
