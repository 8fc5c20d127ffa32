// Reads the law D(v) of a mat from the file of the option --law.
#pragma once

#include <optional>
#include <string>

#include "cli/tool.h"
#include "contact/power_law.h"
#include "contact/table_law.h"

namespace rolling {

/// Reads a row of fitpower (a file with columns a and b) or a table of v and D; `-` is standard
/// input. A row sets `law`, and `slope` and `v0` [m/s] if it has these columns and v0 is not null,
/// except for values that are on the command line. A table is returned; with -a or -b it is
/// refused. Columns with units are converted to SI. Throws Error for any other file and for more
/// than one row.
std::optional<TableLaw> read_law(Tool&, const std::string& file, PowerLaw& law, double& slope,
                                 double* v0 = nullptr);

}  // namespace rolling
