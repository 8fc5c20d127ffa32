// Rows on their way through a filter: each waits, as the text it came as, for the numbers that the
// filter owes it. So a filter may answer late (a window that looks ahead) and every byte that it
// does not compute still goes out as it came in. Answered rows wait for company: the digits of one
// number wait for each other, those of several numbers do not. Each run goes out with its own head:
// its name, its comments and history, what this filter did, the names.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "text/bytes.h"
#include "text/output.h"
#include "text/reader.h"

namespace rolling {

class Filter {
 public:
  /// `history` is the `##` line, without the marks, that says what this filter did. Without it
  /// nothing goes out before it has been told.
  Filter(Reader& in, Output& out, std::string history = {});
  /// Writes the rows that have all their numbers, when an Error ends the work before the last run
  /// has.
  ~Filter();
  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;
  void tell(std::string history);  ///< nothing, if the filter changes no number

  /// The numbers replace the column in this slot of the reader.
  void replace(std::size_t slot) { replaced_ = slot; }
  /// The numbers are a new last column; several columns take them in turn. A column of that name
  /// becomes `name_in`.
  void append(Column);

  /// Goes to the next run or record, as Reader does; the record waits for its numbers.
  bool next_run();
  bool next();
  double operator[](std::size_t slot) const { return in_[slot]; }
  /// The next number for the oldest row that has not all of them. Throws Error when it is not
  /// finite.
  void put(double value) {
    require_finite(value);
    numbers_.push_back(value);
    if (numbers_.size() >= enough_) write_rows();
  }
  void put(std::span<const double> values) {
    for (const double value : values) put(value);
  }
  /// Leaves out the record that is the i-th of this run, from 0: it waits for no numbers.
  void drop(std::size_t i);

 private:
  enum class Kind { record, remark, head, dropped };
  struct Row {
    Kind kind = Kind::record;
    std::size_t size = 0;  // of its text
    std::size_t first = 0,
                last = 0;  // of a record, its numbers go between; of a head, this filter's history
  };

  std::size_t rows_at_once() const { return out_.unbuffered ? 1 : 32; }
  std::vector<Column> columns() const;
  void take_head();
  void take_remarks(const std::vector<std::string>&);
  void write_rows();
  void write_head();
  void forget_rows();

  Reader& in_;
  Output& out_;
  std::optional<std::string> history_;  // lines; none until it has been told
  std::vector<Column> appended_;
  std::size_t replaced_ = Reader::no_column;  // a slot
  std::size_t cut_ = Reader::no_column;       // its column in this run
  std::vector<Row> rows_;                     // those that wait, from front_ on
  Bytes held_;                                // their texts, one after the other
  std::vector<double> numbers_;               // for them, in order
  std::size_t enough_;                        // numbers to write rows for
  std::size_t front_ = 0;
  std::size_t front_begin_ = 0;  // where the text of the front row begins
  std::ptrdiff_t gone_ =
      0;  // records of this run that are no longer among them, less those of earlier runs that are
  struct Head {  // of a run none of whose rows has been written
    bool due = false;
    std::string comments, names;
  } head_;
  bool any_row_ = false, any_dropped_ = false;
  bool writing_ = false;  // true for good when a write has failed
};

}  // namespace rolling
