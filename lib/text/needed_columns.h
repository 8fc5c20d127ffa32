// SPDX-License-Identifier: GPL-3.0-or-later
// The columns that a tool needs: which columns of a run they are, and how they become SI units.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/column.h"
#include "text/unit.h"

namespace rolling {

class NeededColumns {
 public:
  static constexpr std::size_t no_column = static_cast<std::size_t>(-1);
  enum class Kind {
    needed,  ///< of a quantity: converted to SI, and a row without it is left out
    as_is,   ///< under this name, and converted from its unit alone
    wanted,  ///< as needed, but it may be absent, and its readings may be missing
    beside   ///< as wanted, to compare with: what cannot be read is missing too
  };
  struct Needed {
    std::string name;      ///< in the call of add()
    std::string quantity;  ///< that it serves as
    Kind kind;
    /// Of a quantity that is not known; it may not change between runs. As it is: the SI unit.
    std::string unit{};
    std::size_t column = no_column;
    Conversion to_si{};
    std::string clock{};  ///< of a time: its unit, if that is one of a clock
  };

  /// `use`: texts of the form NAME=COLUMN or NAME=COLUMN[UNIT]. `has_use`: messages may name the
  /// option --use. Throws Error for another form of `use`, and for two columns of one quantity.
  NeededColumns(const std::vector<std::string>& use, bool has_use);
  /// The names that a file without names has: `order` up to the first one that --use assigns to
  /// another place, because the order of those behind it is then unknown.
  std::vector<std::string> names_without_use(std::vector<std::string> order) const;
  /// --use assigns a column by its number, which counts the fields of a line.
  bool use_has_numbers() const;

  /// Finds the columns again among those of the next run. `named`: the file names them. `said`: the
  /// units in its comments.
  /// Throws Error if one is absent, or has another quantity or unit than in the runs before.
  void begin_run(std::vector<Column> as_read, bool named, SaidUnits said);
  /// Declares a column, as it is in this SI unit; returns its slot, its index in all(). Throws
  /// Error like begin_run().
  std::size_t add(std::string_view name, Kind, std::string_view unit = {});
  const std::vector<Needed>& all() const { return needed_; }

  /// Index of the column that serves as `name` (a name, a 1-based number, or what --use says), if
  /// there is one. Where no name is t, or v or x, the only column in a unit of it serves as it.
  /// Throws Error where there are several.
  std::optional<std::size_t> find(std::string_view name) const;
  /// Index of the only column of this quantity or name, if its unit is known; nothing is refused.
  std::optional<std::size_t> find_beside(std::string_view name) const;
  /// The columns of this run with the names and units of the output: a column that serves as a
  /// quantity has its name and unit; another column of that name is renamed.
  const std::vector<Column>& in_output() const { return in_output_; }
  /// A needed column of this run has another name in the file.
  bool renames() const;
  /// The quantities so far whose columns say neither quantity nor unit, or have no unit where a
  /// comment says one, or that only their units tell: `t is column 1, 'Frame', taken in s; v is
  /// column 2, 'Wind', by its unit`. Empty if there is none.
  const std::string& assumed() const { return assumed_; }

 private:
  [[noreturn]] void refuse(std::string_view name) const;
  std::optional<std::size_t> written_as(std::string_view name) const;
  std::optional<std::size_t> take_use(const std::string& column);
  bool may_be_time(std::size_t column) const;
  void serve_by_units();
  void refuse_other_times(std::size_t column) const;
  std::string list() const;
  std::string shown_name(std::size_t column) const;
  [[noreturn]] void refuse_unit(const Needed&, const Column& meant) const;
  void resolve(Needed&);
  void assume(std::size_t column, std::string_view quantity, std::string_view what);
  Conversion conversion(Needed&);
  void name_columns();

  std::map<std::string, std::string> use_;  // what --use gives a quantity, as it was typed
  bool has_use_;
  std::vector<Needed> needed_;
  std::string assumed_;

  // The run.
  std::vector<Column> as_read_;
  std::vector<Column> in_output_;
  std::vector<std::string> quantities_;  // by --use, by its unit, else the name of each column
  bool named_ = false;
  SaidUnits said_;
};

}  // namespace rolling
