// The law D(v) of a mat from a file: what --law reads.
#pragma once

#include <optional>
#include <string>

#include "cli/tool.h"
#include "contact/power_law.h"
#include "contact/table_law.h"

namespace rolling {

/// Reads a row of fitpower (columns a and b, and v0 if it has that), or a table of v and D; `-` is
/// standard input. A row sets `law`, and v0 [m/s] if that is asked for, where the command line has
/// not: it wins. A table is returned; -a and -b do not go with it. Columns with units are converted
/// to SI. Throws Error for a file that is neither, and for more than one row.
std::optional<TableLaw> read_law(Tool&, const std::string& file, PowerLaw& law,
                                 double* v0 = nullptr);

}  // namespace rolling
