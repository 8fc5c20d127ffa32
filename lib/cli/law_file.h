// SPDX-License-Identifier: GPL-3.0-or-later
// Laws D(v) as people write them, and the file of the option --law.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/matrix.h"
#include "cli/tool.h"
#include "contact/law.h"
#include "text/column.h"

namespace rolling {

/// The law of the table with this formula: "d0+d2*v^2", blanks and * or not. The exponent of
/// d0 + a v^b may be called n, and d0, d1, d2 may be called f0, f1, f2. Throws Error, which lists
/// the laws, for another formula.
const LawForm& law_named(const std::string& formula);

/// The columns of the coefficients of a law: d0[m], d2[s^2/m].
std::vector<Column> columns_of(const LawForm&);

/// The columns of their correlations, row by row below the diagonal: corr of a v^b, corr_d0_d2.
std::vector<std::string> correlations_of(const LawForm&);

/// "a 0.00187 b 0.215", "d0 0.001 d2 0.0004" or "table", for `##` lines.
std::string words_of(const Law&);

/// The options of a law, and their values.
struct LawOptions {
  PowerLaw power{not_given, not_given};
  std::string file = {};
};

/// -a, -b and --law.
void add_options(Tool&, LawOptions&);

/// A number that a row of fitpower may have, under the name of an option of the tool.
struct RowNumber {
  const char* name;  ///< slope, v0, x0 or t0
  const char* unit;
  double* value;
};

/// A law as a file tells it.
struct LawOfFile {
  Law law;
  /// Of a row, where they are asked for: the coefficients of the formula in SI units, and their
  /// correlations row by row below the diagonal.
  std::vector<Estimate> coefficients = {};
  Matrix correlations = {};

  /// The standard uncertainty of D [m] at a velocity: that of a function of quantities that are
  /// correlated (GUM, Eq. 16). NaN where the law is not a row with its uncertainties.
  double sigma(double v) const;
};

/// The law that the options tell: a v^b if there is no file, which then needs a and b; else a table
/// of v and D, or a row of fitpower, a file with the columns of the coefficients of a law, which
/// sets these numbers too. `-` is standard input. What the command line gives takes precedence: a
/// and b, which replace the law together, and the numbers; these keep their values where the row
/// has no such column. Columns with units are converted to SI. `with_errors`: a row needs its
/// uncertainties. Throws Error for any other file, for more than one row, for a row that sets
/// nothing, and for another law than a v^b beside -a or -b.
LawOfFile read_law(Tool&, const LawOptions&, const std::vector<RowNumber>&,
                   bool with_errors = false);

}  // namespace rolling
