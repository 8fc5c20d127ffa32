// Units that stand in a line of their own below the names of their columns.
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

}  // namespace rolling
