// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the law D(v) of a mat from the file of the option --law.
#pragma once

#include <optional>
#include <string>

#include "cli/tool.h"
#include "contact/law.h"

namespace rolling {

/// What the file says: points, or the numbers of a row of fitpower. A number is empty where the
/// row has no such column, or where the command line gives the value, which takes precedence.
struct LawFile {
  std::optional<Law> points = {};
  std::optional<double> a = {}, b = {}, slope = {}, v0 = {};  ///< SI units

  /// `given`, with a and b replaced by those of the file.
  PowerLaw law_or(PowerLaw given) const { return {a.value_or(given.a), b.value_or(given.b)}; }
};

/// Reads a row of fitpower (a file with columns a and b) or a table of v and D; `-` is standard
/// input. Columns with units are converted to SI; v0 is read only for a tool with the option --v0.
/// Throws Error for any other file, for more than one row, and for a table beside -a or -b.
LawFile read_law(Tool&, const std::string& file);

}  // namespace rolling
