// SPDX-License-Identifier: GPL-3.0-or-later
// Laws D(v) as people write them, and the file of the option --law.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/tool.h"
#include "contact/law.h"
#include "text/column.h"

namespace rolling {

/// The law of the table with this formula: "d0+d2*v^2", blanks and * or not. The exponent of
/// d0 + a v^b may be called n. Throws Error, which lists them, for another.
const LawForm& law_named(const std::string& formula);

/// The columns of the coefficients of a law: d0[m], d2[s^2/m].
std::vector<Column> columns_of(const LawForm&);

/// "a 0.00187 b 0.215", "d0 0.001 d2 0.0004" or "table", for `##` lines.
std::string words_of(const Law&);

/// A number that a row of fitpower may have, under the name of an option of the tool.
struct RowNumber {
  const char* name;  ///< slope, v0, x0 or t0
  double* value;     ///< SI units
};

/// Reads a table of v and D, which is returned, or a row of fitpower, which sets these numbers: a
/// file with the columns of the coefficients of a law. Those of a v^b are set, another law is
/// returned. `-` is standard input. A number keeps its value where the row has no such column, or
/// where the command line gives it, which takes precedence. Columns with units are converted to SI.
/// Throws Error for any other file, for more than one row, for a row that sets nothing, and for
/// another law than a v^b beside -a or -b.
std::optional<Law> read_law(Tool&, const std::string& file, PowerLaw&,
                            const std::vector<RowNumber>&);

}  // namespace rolling
