// Rows on their way through a filter: each waits, as the text it came as, for the numbers that the filter owes it. So a
// filter may answer late (a window that looks ahead) and every byte that it does not compute still goes out as it came in.
// What is answered before the next record is read has not been copied for that.
#pragma once

#include <string>
#include <vector>

#include "text/output.h"
#include "text/reader.h"

namespace rolling {

class Filter {
 public:
  /// `history` is the `##` line, without the marks, that says what this filter did. Without it nothing goes out before
  /// it has been told.
  Filter(Reader& in, Output& out, std::string history = {});
  void tell(std::string history);

  /// The numbers replace the column in this slot of the reader.
  void replace(std::size_t slot) { cut_ = in_.column_of(slot); }
  /// The numbers are a new last column; several columns take them in turn. A column of that name becomes `name_in`.
  void append(Column);

  /// Goes to the next run or record, as Reader does; the record waits for its numbers.
  bool next_run();
  bool next();
  double operator[](std::size_t slot) const { return in_[slot]; }
  /// The next number for the oldest row that waits. Throws Error when it is not finite.
  void put(double value);
  /// Leaves out the record that is the i-th of this run, from 0: it waits for no numbers.
  void drop(std::size_t i);

 private:
  enum class Kind { record, comment, dropped };
  struct Row {
    Kind kind = Kind::record;
    std::size_t size = 0;             // of its text
    std::size_t first = 0, last = 0;  // of a record: its numbers go between
  };

  void hold();
  void write_header();
  void comment(std::string_view text);
  void clear_front();
  void write_break();
  void remove_row();

  Reader& in_;
  Output& out_;
  std::string history_;
  std::vector<Column> columns_;
  std::size_t appended_ = 0, cut_ = static_cast<std::size_t>(-1);
  Row present_;               // the record read last, as long as it is not among those that wait
  std::string_view text_;     // its text
  bool present_waits_ = false;
  std::vector<Row> rows_;     // those before it that wait, from front_ on
  std::string held_;          // their texts, one after the other
  std::size_t front_ = 0;
  std::size_t front_begin_ = 0;  // where the text of the front row begins
  std::size_t numbers_ = 0;   // that the front row has got
  std::size_t gone_ = 0;      // records of this run that are no longer among them
  bool header_written_ = false, break_due_ = false, any_row_ = false, any_dropped_ = false;
};

}  // namespace rolling
