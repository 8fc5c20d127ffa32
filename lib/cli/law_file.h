// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the law D(v) of a mat from the file of the option --law.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/tool.h"
#include "contact/law.h"

namespace rolling {

/// A number that a row of fitpower may have, under the name of an option of the tool.
struct RowNumber {
  const char* name;  ///< slope, v0, x0 or t0
  double* value;     ///< SI units
};

/// Reads a table of v and D, which is returned, or a row of fitpower (a file with columns a and b),
/// which sets the law and these numbers; `-` is standard input. A number keeps its value where the
/// row has no such column, or where the command line gives it, which takes precedence. Columns with
/// units are converted to SI. Throws Error for any other file, for more than one row, for a row
/// that sets nothing, and for a table beside -a or -b.
std::optional<Law> read_law(Tool&, const std::string& file, PowerLaw&,
                            const std::vector<RowNumber>&);

}  // namespace rolling
