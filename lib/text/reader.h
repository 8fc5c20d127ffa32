// Records from files of columns: rolling-columns(5). The reader knows what the header says, which
// columns are needed, and where each record stands; what the numbers mean is not its business.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "text/bytes.h"
#include "text/column.h"
#include "text/dialect.h"
#include "text/header.h"
#include "text/lines.h"

namespace rolling {

struct ReaderOptions {
  std::vector<std::string> files;  ///< operands, in order; none is standard input
  std::vector<std::string> use;    ///< NAME=COLUMN
  std::optional<int> run;          ///< only this one
  bool strict = false;             ///< a missing reading is an error
  BlockHook on_block = {};         ///< told how far a file has been read
  bool has_use = true;             ///< a refusal may propose --use for this file
};

class Reader {
 public:
  /// Reads up to the first record. `order` names the columns of a file without names.
  Reader(ReaderOptions, std::vector<std::string> order);

  // The header.
  const std::vector<Column>& columns() const { return columns_; }
  /// Index of the column that serves as `name` (a name, a 1-based number, or what --use says), if
  /// there is one.
  std::optional<std::size_t> find(std::string_view name) const;
  /// The comments before the records and the history in them.
  const std::vector<std::string>& comments() const { return comments_; }

  /// Declares a column needed: its numbers are parsed, converted to SI, and never missing. Returns
  /// its slot for operator[]. Throws Error when there is none.
  std::size_t need(std::string_view name);
  /// The same for a column whose readings may be missing: they are NaN.
  std::size_t want(std::string_view name);
  /// The same as need() for a column that is no known quantity here, whatever its name and unit
  /// (the a of a law): nothing is converted.
  std::size_t need_as_is(std::string_view name);
  /// Needs t, increasing strictly within a run.
  std::size_t need_time();
  /// Where a needed column stands in a record.
  std::size_t column_of(std::size_t slot) const { return needed_[slot].column; }

  // The records.
  /// Goes to the next run; false when there is none.
  bool next_run();
  /// Goes to the next record of this run; false at its end.
  bool next();
  /// About as many records as this file still has, and an eighth more; of a pipe, as have been
  /// read.
  std::size_t records_ahead() const { return lines_->lines_ahead(); }
  /// The number in a needed column [SI].
  double operator[](std::size_t slot) const { return values_[slot]; }
  /// The record as it goes out, tab-separated, valid until the next one; if `cut` is a column, its
  /// text is [first, last) of that.
  std::string_view text(std::size_t cut, std::size_t& first, std::size_t& last) {
    if (!dialect_.as_it_stands() || converts_ || header_.layout.side_by_side)
      return made_text(cut, first, last);
    const std::string_view line = lines_->text();
    if (cut < fields_.size()) {
      first = static_cast<std::size_t>(fields_[cut].text.data() - line.data());
      last = first + fields_[cut].text.size();
    }
    return line;
  }

  /// Called with each comment line among the records; comments before them are in comments().
  std::function<void(std::string_view)> on_comment;
  /// The `##` lines that hold for the present run, without the marks.
  const std::vector<std::string>& history() const { return history_; }
  /// True once after the history has changed since the last call.
  bool history_changed() { return std::exchange(history_changed_, false); }

  /// `file:line` of the present record; empty before the first one of a file, and when all input
  /// has been read.
  std::string where() const;
  std::size_t left_out() const {
    return left_out_;
  }  ///< records left out because a needed cell was missing
  /// Some times are so large that a double keeps fewer than four digits of the time between two
  /// records.
  bool coarse_time() const { return coarse_time_; }

 private:
  struct Needed {
    std::size_t column;
    std::string name;
    Conversion to_si;
    bool may_miss = false;
  };
  enum class Event { record, run_break, end };

  void open_next();
  void want_numbers();
  void comment(std::string_view line);
  std::optional<std::size_t> find_column(std::string_view name, const std::vector<Column>&) const;
  std::size_t require(std::string_view name) const;
  std::size_t add(std::size_t column, const std::string& name, Conversion);
  std::string column_list() const;

  Event advance();
  bool take_plain_line();
  bool names_again();
  bool has_own_reading();
  std::span<const Field> split_line();
  bool take_record();
  std::string_view made_text(std::size_t cut, std::size_t& first, std::size_t& last);
  [[noreturn]] void reject(std::size_t column, std::string_view why) const;
  std::string way_out(std::string_view field) const;

  ReaderOptions options_;
  std::map<std::string, std::string> use_;  // quantity, column
  std::vector<std::string> order_;
  std::unique_ptr<Lines> lines_;
  std::size_t next_file_ = 0;

  // What the headers say.
  Header header_;
  Dialect dialect_;
  std::vector<Column> columns_, columns_as_read_;
  std::vector<std::string> comments_, history_;
  bool in_header_ = true, history_changed_ = false, history_ended_ = false;

  // The present record.
  Bytes text_;               // if it does not go out as it came
  bool line_waits_ = false;  // the present line is read but not taken
  std::size_t first_record_ = 0;
  std::span<const Field> fields_;
  std::vector<Field> own_fields_;  // of runs side by side

  // What is needed of it.
  std::vector<Needed> needed_;
  bool converts_ = false;
  std::vector<double> values_;
  std::size_t time_slot_ = static_cast<std::size_t>(-1);
  double last_time_ = 0;
  bool coarse_time_ = false;

  // Runs.
  std::size_t side_ = 0;
  int run_ = 0;
  bool run_found_ = false, run_begins_ = false, first_of_run_ = true, file_ended_ = false,
       skipping_ = false, begun_ = false, at_end_ = false;
  std::size_t left_out_ = 0;
};

}  // namespace rolling
