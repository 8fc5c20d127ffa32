// Units that stand apart from the names of their columns: in comments, or in lines of their own.
// A `place` is the FILE:LINE of an InputError.
#pragma once

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

/// Notes the units other than SI that a comment gives to columns whose names have none: behind the
/// names of known quantities (`t [ms]`, `time in ms`), or in the order of the columns, two known
/// units or more of them.
void note_other_units(const std::string& comment, std::vector<Column>&);

/// Refuses a comment with units that does not name the `width` columns of the records: columns
/// without names are read in SI units, which would contradict it. If the columns are `named`
/// already, units without names do not.
void refuse_units_of_others(const std::string& comment, std::size_t width, bool named,
                            std::string_view place);

/// Refuses a line of units that is not read, if they are not all SI.
void refuse_line_of_units(const std::vector<std::string>& fields, std::string_view place);

}  // namespace rolling
