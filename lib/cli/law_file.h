// The law D(v) of a mat from a file: what --law reads.
#pragma once

#include <optional>
#include <string>

#include "cli/tool.h"
#include "contact/power_law.h"
#include "contact/table_law.h"

namespace rolling {

/// Reads a row of fitpower, or a table of v and D; `-` is standard input. A row sets the law by its
/// columns a and b, and where it has them the slope of the mat, and v0 [m/s] if that is asked for;
/// the command line wins over it. A table is returned; -a and -b do not go with it. Columns with
/// units are converted to SI. Throws Error for a file that is neither, and for more than one row.
std::optional<TableLaw> read_law(Tool&, const std::string& file, PowerLaw& law, double& slope,
                                 double* v0 = nullptr);

}  // namespace rolling
