// Units that stand apart from the names of their columns: in comments, or in lines of their own.
// A `place` is the FILE:LINE of an InputError.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "text/column.h"

namespace rolling {

/// Whether the fields of the line above the records are the units of the names in the line above
/// it, which has as many: none of them is a known name, and one of `names` is or two of them are
/// known units.
bool are_units_of(const std::vector<std::string>& names, const std::vector<std::string>& fields);

/// Gives a column the unit that stands below its name. Refuses one other than that of the name.
void add_unit(Column&, std::string_view unit, std::string_view place);

/// The units other than SI that comments say, by the quantity that may have them: its columns are
/// not read in SI units if their names have none.
struct SaidUnit {
  std::string unit;
  std::size_t line;  ///< the number of the line that says it
};
using SaidUnits = std::map<std::string, SaidUnit>;

/// Adds those of a comment.
void note_units(const std::string& comment, std::size_t line, SaidUnits&);

}  // namespace rolling
