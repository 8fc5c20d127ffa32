// SPDX-License-Identifier: GPL-3.0-or-later
// Laws D(v) as people write them, the line above the rows of fitpower, and the file of the option
// --law.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "cli/tool.h"
#include "law/law.h"
#include "contact/road.h"
#include "fit/input.h"
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

/// " slope 0.01 wind 2 height FILE steepness 0.99", each if there is one, for `##` lines.
std::string words_of(const Body&, const std::string& height);

/// The line of fitpower above its rows: `fitpower VERSION ROUTE [LAW] K 0.5+-0.005 R 0.04 g 9.81
/// slope 0 [wind 0] [exact]`, with a list where the runs differ, and `slope fit` where the slope is
/// in the rows. Without the numbers if those of a run are not known.
std::string line_of_fit(const std::string& route, const FitOptions&,
                        const std::vector<std::optional<Body>>& of_runs);

/// The options of a law, and their values.
struct LawOptions {
  PowerLaw power{not_given, not_given};
  std::string file = {};
};

/// -a, -b and --law.
void add_options(Tool&, LawOptions&);

/// Throws Error for a wind under a law that has no term for the drag of the air.
void check_wind(const Body&, const Law&);

/// --height, and the road of its table, x and h; none without a file. Refuses a slope beside it
/// that is not fitted.
void add_height(Tool&, std::string& file);
std::unique_ptr<const Road> read_road(Tool&, const std::string& file, bool fit_slope = false);

/// A law as a file tells it, and the body that rolls under it.
struct LawOfFile {
  Law law = {};
  /// Of the options; where these give no number, of the row of fitpower and its `##` line.
  Body body = {};
  std::optional<Body> fitted_with = {};  ///< by the `##` line above the row, if it says so
  std::string run = {};                  ///< the run that the row is of, if it has a column run
  /// What the row has of its roll; else NaN.
  double slope = not_given;
  double wind = not_given;
  double steepness = not_given;
  double v0 = not_given;
  double x0 = not_given;
  double t0 = not_given;
  /// Of a row; with their uncertainties and correlations (row by row below the diagonal) where
  /// these are asked for.
  std::vector<Estimate> coefficients = {};
  Matrix correlations = {};

  /// The standard uncertainty of a number with these derivatives by the coefficients: that of a
  /// function of quantities that are correlated (GUM, Eq. 16). NaN where the law is not a row with
  /// its uncertainties.
  double sigma(std::span<const double> by_c) const;
  /// That of D [m] at a velocity.
  double sigma(double v) const;
};

/// The rows of fitpower in all runs of the input, for one law: `of_row` gets each while it is the
/// present row. Throws Error for an a that is not above 0.
std::vector<LawOfFile> rows_of_fit(Reader&, const LawForm&, bool with_errors,
                                   const std::function<void(const LawOfFile&)>& of_row);

/// The laws that the options tell: a v^b if there is no file, which then needs a and b; else a
/// table of v and D, or rows of fitpower, a file with the columns of the coefficients of a law.
/// Several rows have a column run with different names. `-` is standard input. -a and -b on the
/// command line replace the law of a row together. `given` is what the options give of the body,
/// where K and R may be NaN; the row completes it, and where it has other numbers than are given,
/// a line says so. Columns with units are converted to SI. `with_errors`: a row needs its
/// uncertainties. Throws Error for any other file, for rows of several laws, for a body without K
/// or R, and for rows that add nothing to the command line.
std::vector<LawOfFile> read_laws(Tool&, const LawOptions&, const Body& given,
                                 bool with_errors = false);

/// Completes what the options give of a body by the one with which a law was fitted to a run. Warns
/// of the numbers that the options give otherwise: "K 0.5 (here 0.83)" stands for {} in the text of
/// the warning.
void take_body(Tool&, const std::string& run, const char* warning, const Body& of_law, Body&);

/// Takes a geometry unless the options give one; adds it to `others` where that is another one.
void take_geometry(const Tool&, bool other, bool& exact, std::string& others);

/// The law of this run: the only one there is, or that of the row with its name. Throws Error if
/// there is none.
const LawOfFile& law_of(const std::vector<LawOfFile>&, const std::string& run);

}  // namespace rolling
