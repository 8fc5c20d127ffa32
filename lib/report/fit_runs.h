// SPDX-License-Identifier: GPL-3.0-or-later
// The runs of a fit, read from columns and their `##` lines, or their fits, read from rows; and the
// messages of fitpower in addition to its row: warnings, the report, and the check of the fit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/tool.h"
#include "fit/refits.h"
#include "fit/fit.h"
#include "fit/input.h"

namespace rolling {

/// "position"
std::string name_of(Route);

/// The columns that a route fits; the one that it compares stands last.
std::vector<Quantity> columns_of(Route);

/// Reads all runs with their names and their filters, but without the numbers of the body. Warns
/// of `##` lines that are not trusted or that one run lacks, and of rows that are left out because
/// their windows are not known.
std::vector<Run> read_runs(Tool&, Reader&, Route, bool needs_x = false);

/// Speeds of a wheel's pulses are one fixed distance over the time from row to row. If all runs
/// have such speeds, this gives them the positions of their pulses, which are what was measured,
/// says so, and returns true.
bool take_pulses(Tool&, std::vector<Run>&);

/// The largest speed of a run without its sign; NaN if no speed is known.
double fastest(const Run&);

/// What the options give of the runs.
struct Bodies {
  std::vector<Body> all{{}};        ///< one, or one for each run
  std::string list = {};            ///< the option that has one for each run
  std::vector<double> begins = {};  ///< x0 of runs of speeds on a road, likewise
  std::string height = {};          ///< the file of the road
  bool exact = false;               ///< the geometry, see Body

  void give_to(std::vector<Run>&) const;
};

/// Objects to a run that was given twice, which makes the errors of a joint fit too small. A copy
/// has all fitted columns of the other run, t too: gates fix x, speed bands fix v, and both measure
/// t. Fewer than ten readings may be equal by chance.
void warn_of_copies(Tool&, Route, const std::vector<Run>&);

/// Warns of a geometry and of numbers of the body that a fit of D does not use: D was computed with
/// others, or it is not known with which.
void warn_of_unused_body(Tool&, const std::vector<Run>&);

/// A number of a row of fitpower, and its column.
struct Cell {
  Column column;
  double value;  ///< NaN for a blank cell
};

/// Writes the `##` line, the header and the rows, which have the same columns; with names of runs,
/// these are in a last column.
void write_table(Output&, const std::string& line, const std::vector<std::vector<Cell>>& rows,
                 const std::vector<std::string>& runs = {});

/// The route fits: reads rows of fitpower and prints their joint law (statistics/run_laws.h). What
/// the uncertainties of K, R and g have brought to each row is common to the rows that give the
/// same number with the same uncertainty.
void fit_rows(Tool&, const Bodies&);

/// Runs that are fitted together, and their fit.
struct FitOfRuns {
  Route route;
  std::vector<Run> runs;
  std::optional<FitResult> result = {};    ///< none if they cannot be fitted
  std::optional<LawComparison> laws = {};  ///< if laws are compared
};

/// Warns of a v0 that hardly any such body has: as if km/h, rad/s or pixels were taken for m/s.
void doubt_speed(Tool&, const FitOfRuns&);

/// "p = 0.003"
std::string p_of(double p);

/// "the runs disagree ...: run 3 is furthest from the others, in D(0.21 m/s) by -4.1 +- 0.4 %, in
/// its exponent by +0.012 +- 0.004; ...". In a check also, if the runs agree as a whole, that one
/// of them is off. Empty if neither is so.
std::string disagreement(const Agreement&, const std::vector<Run>&, bool check);

/// Warns of what spoils a fit: a shift beyond the radius, runs that disagree, readings that are off
/// or repeat, a b far below what mats have. If there is none of it, and no law is better, also of
/// what such a cause would bring with it: noise that is not white, an eccentric body, an a whose
/// error is not that of a normal distribution. A check fails by a shift beyond the radius, runs
/// that disagree, a reading that is off, such a b and such an a; by standard errors that do not
/// exist (unless a and b are both fixed), another law that is better by 10 in AICc, the beginning
/// of a run that is disturbed, and residuals that are not white: these three at levels for one of
/// so many fits.
void remark(Tool&, const FitOfRuns&, const FitOptions&, std::size_t fits);

/// Reports how the uncertainties were made, and their parts; the coefficients of all laws, and
/// whether another is better than this.
void report(Tool&, const FitOfRuns&, const LawForm&);

}  // namespace rolling
