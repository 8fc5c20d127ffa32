// SPDX-License-Identifier: GPL-3.0-or-later
// The name of a column: its quantity, its unit and its run.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "text/unit.h"

namespace rolling {

struct Column {
  /// t, x, v, a or D for a known quantity; else the name of the file, with underscores for blanks.
  std::string name{};
  /// The unit of the file, with ^2 for a superscript; empty if the name has no unit.
  std::string unit{};
  /// The number in `Run #2` or `Data Set 1:`, the word in `Latest:`; empty if the name has neither.
  std::string run{};
  /// The name as it stands in the file, with its unit; empty for a column that no file names.
  std::string written{};

  /// Whether both mean the same, however they are written.
  bool operator==(const Column& other) const {
    return name == other.name && unit == other.unit && run == other.run;
  }
};

/// Reads `v[m/s]`, `Velocity (m/s)`, `Time(s)`, `Time in s`, `Latest: Time (s)`, `Data Set
/// 1:Time(s)`, `Velocity (m/s) Run #2`, or a bare name. Of several brackets the last is the unit:
/// `Speed (OBD)(km/h)`.
Column read_column(std::string_view text);

/// With an underscore for each blank, as names go out.
std::string with_underscores(std::string_view name);

/// The name with the label of a run, for a column that is of no run of its own: `Engine:Load`.
std::string labelled_name(const Column&);

/// The form in which the tools write names: `v[m/s]`.
std::string to_text(const Column&);

/// The new name of a column whose name is given to a computed one: `name_in`; `name_in_in` and so
/// on if that name exists too.
std::string free_name(const std::vector<Column>&, std::string name);

/// Whether a column is t, x, v, a or D.
bool is_known(const Column&);

/// The names in a line, one for each field; a name may stand in quotes, and what is in brackets is
/// not separated. With `separator` 0 blanks separate the names; a unit in brackets then belongs to
/// the name before it.
std::vector<std::string> split_names(std::string_view line, char separator);

}  // namespace rolling
