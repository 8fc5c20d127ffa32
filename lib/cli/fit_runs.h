// SPDX-License-Identifier: GPL-3.0-or-later
// The runs of a fit, read from columns and their `##` lines.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/tool.h"
#include "fit/input.h"

namespace rolling {

/// A route as the command line and the columns know it.
struct RouteWords {
  Route route;
  const char* name;
  std::vector<std::string> columns;  ///< that it fits, by their short names
  const char* why_left_out;          ///< why it leaves rows out
};
/// In the order of their names.
const std::vector<RouteWords>& all_routes();
const RouteWords& words_of(Route);

/// The column of a run with this short name: t, x, v or D.
std::vector<double> FitRun::*column_of(std::string_view name);

/// The columns that are read: those that the route fits, or those of the other routes too.
enum class Columns { of_route, of_all_routes };

/// Reads all runs with their names and their filters, but without the numbers of the body. Warns
/// of readings that a logger held, of `##` lines that are not trusted or that one run lacks, and of
/// rows that are left out because their windows are not known.
std::vector<FitRun> read_runs(Tool&, Reader&, Route, Columns);

/// Where the speeds of all runs are those of pulses, a fixed way over the time from row to row,
/// gives the runs that way as positions, says so, and returns true: the positions are what was
/// measured.
bool take_pulses(Tool&, std::vector<FitRun>&);

/// The bodies as the command line gives them: one shape factor, or one for each run, or none; and
/// so one radius.
struct Bodies {
  Body body = {};  ///< but for K and R
  BodyUncertainty uncertainty = {};
  std::vector<Estimate> shape_factors = {}, radii = {};

  void give_to(std::vector<FitRun>&) const;
};

/// Warns of a run that was given twice: in a joint fit it makes the errors too small. All columns
/// that are fitted are those of the other run: gates and speed bands fix x or v, and measure t.
/// Fewer than ten readings may be equal by chance.
void warn_of_copies(Tool&, Route, const std::vector<FitRun>&);

/// Warns of a geometry and of numbers of the body that a fit of D does not use: D was computed with
/// others, or it is not known with which.
void warn_of_unused_body(Tool&, const std::vector<FitRun>&, Geometry);

}  // namespace rolling
