// Records from files of columns: rolling-columns(5). The reader knows what the heads say, which
// columns are needed, and where each record stands; what the numbers mean is not its business.
#pragma once

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
#include "text/head.h"
#include "text/lines.h"
#include "text/side_by_side.h"

namespace rolling {

struct ReaderOptions {
  std::vector<std::string> files;  ///< operands, in order; none is standard input
  std::vector<std::string> use;    ///< NAME=COLUMN, or NAME=COLUMN[UNIT]
  std::optional<int> run;          ///< only this one
  bool strict = false;             ///< a missing reading is an error
  BlockHook on_block = {};         ///< told how far a file has been read
  bool has_use = true;             ///< a refusal may propose --use for this file
};

class Reader {
 public:
  /// Reads up to the first record of the first run. `order` names the columns of a file without
  /// names, up to the first that --use takes from elsewhere.
  Reader(ReaderOptions, std::vector<std::string> order);

  // What stands in front of the present run; before next_run(), of the first.
  /// Its columns under the names that they serve as, in their units.
  const std::vector<Column>& columns() const { return columns_; }
  /// Index of the column that serves as `name` (a name, a 1-based number, or what --use says), if
  /// there is one.
  std::optional<std::size_t> find(std::string_view name) const;
  /// Its comments, the history and the line `## run NAME` among them, as they go out.
  const std::vector<std::string>& comments() const { return comments_; }
  /// Its own `##` lines, without the marks; none of another run.
  const std::vector<std::string>& history() const { return head_.history; }
  /// Its name: that of a line `## run NAME`; else the base name of its file, with the label that
  /// the names print, or with its number in a file of several.
  std::string run_name() const;

  /// Declares a column needed: its numbers are parsed, converted to SI, and never missing. Returns
  /// its slot for operator[]. Throws Error when there is none, in this run or in a later one.
  std::size_t need(std::string_view name) { return add(name, Kind::needed); }
  /// The same for a column whose readings may be missing, in later runs the whole column: they are
  /// NaN.
  std::size_t want(std::string_view name) { return add(name, Kind::wanted); }
  /// The same as need() for a column that is no known quantity here, whatever its name and unit
  /// (the a of a law): nothing is converted.
  std::size_t need_as_is(std::string_view name) { return add(name, Kind::as_is); }
  /// Needs t, increasing strictly within a run.
  std::size_t need_time() { return time_slot_ = need("t"); }
  /// Where a needed column stands in the records of the present run.
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

  /// A record as it goes out, tab-separated; the text of one column is [first, last) of it.
  struct Text {
    std::string_view line;
    std::size_t first = 0, last = 0;
  };
  static constexpr std::size_t no_column = static_cast<std::size_t>(-1);
  /// The present record, valid until the next one.
  Text text(std::size_t column = no_column) {
    if (!dialect_->as_it_stands() || converts_ || fields_changed_) return made_text(column);
    if (column >= fields_.size()) return {line_};
    const std::string_view field = fields_[column].text;
    const auto first = static_cast<std::size_t>(field.data() - line_.data());
    return {line_, first, first + field.size()};
  }
  /// The comments between the record before and the present one; behind the last record of a run,
  /// those up to its end.
  const std::vector<std::string>& remarks() const { return remarks_; }

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
  enum class Kind { needed, wanted, as_is };
  struct Needed {
    std::string name, quantity;  // as asked for; what it serves as
    Kind kind;
    std::string unit{};  // of a quantity that is not known: the same in all runs
    std::size_t column = no_column;
    Conversion to_si{};
  };
  struct Use {
    std::string column, unit;
  };
  enum class State { found, in_run, between, ended };

  // Columns.
  std::size_t add(std::string_view name, Kind);
  void resolve();
  void resolve(Needed&);
  void name_columns();
  std::optional<std::size_t> find_column(std::string_view name) const;
  std::size_t require(std::string_view name) const;
  Column column_as_read(std::size_t column, const std::string& quantity) const;
  std::string column_list() const;
  const Layout::Run& layout() const { return head_.layout.runs[side_]; }

  // Runs.
  bool find_run();
  bool next_head();
  bool next_file();
  void take_head(Head);
  bool asked_for(std::size_t side) const;
  void begin_run();
  bool run_is_named() const;

  // Records.
  bool next_line();
  bool next_side_line();
  bool take_plain_line();
  void refuse_names(std::string_view comment) const;
  void split_line();
  void change_fields();
  bool take_record();
  void check_time();
  Text made_text(std::size_t column);
  [[noreturn]] void reject(std::size_t column, std::string_view why) const;
  std::string way_out(std::string_view field) const;
  std::string here() const;
  std::string head_here() const;

  ReaderOptions options_;
  std::map<std::string, Use> use_;  // by quantity
  std::vector<std::string> order_;
  std::unique_ptr<Lines> lines_;
  std::size_t next_file_ = 0;

  // The run.
  State state_ = State::between;
  Head head_;
  std::size_t side_ = 0;
  std::vector<Side> sides_;  // of runs side by side
  std::size_t side_line_ = 0;
  Dialect file_dialect_, side_dialect_, *dialect_ = &file_dialect_;
  std::vector<Column> columns_;
  std::vector<std::string> comments_, remarks_;
  int run_ = 0;                  // its number in the input, from 1
  std::size_t run_in_file_ = 0;  // and in the file
  bool run_found_ = false, file_open_ = false;

  // Its columns.
  std::vector<Needed> needed_;
  bool converts_ = false;
  std::vector<double> values_;

  // The present record.
  std::string_view line_;
  std::size_t line_number_ = 0;  // 0: there is none
  std::span<const Field> fields_;
  std::vector<Field> changed_fields_;
  bool fields_changed_ = false;
  Bytes text_;  // if it does not go out as it came
  std::size_t first_record_ = 0;
  std::size_t time_slot_ = no_column;
  double last_time_ = 0;  // NaN before the first record of a run
  bool coarse_time_ = false;
  std::size_t left_out_ = 0;
};

}  // namespace rolling
