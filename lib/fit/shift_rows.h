// SPDX-License-Identifier: GPL-3.0-or-later
// The rows (v, D) of the routes loglog and shift, and the law as their model.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "fit/fitted.h"

namespace rolling {

/// The rows that the routes loglog and shift use, all runs in sequence. A body that rolls
/// towards falling x has v < 0 and D < 0; both are taken positive along its direction of motion.
struct ShiftRows {
  std::vector<double> v;          ///< [m/s]
  std::vector<double> y;          ///< D [m], or ln D for the route loglog
  std::vector<std::size_t> runs;  ///< number of rows of each run
  bool logarithms = false;
  std::size_t negative = 0;  ///< number of rows that only D <= 0 leaves out, for logarithms
  /// The geometric mean of v, where the estimates of ln D and b are uncorrelated.
  double v_ref = 0;
};

/// The rows with finite v > 0 of at least options.min_speed, and with D > 0 if `logarithms`;
/// what is no more than the rounding of a difference (base/grid.h) counts as 0. `stops`, if not
/// empty, has the time of each run from which on no row is used. Throws Error if the rows do
/// not determine the parameters.
ShiftRows shift_rows(const std::vector<FitRun>&, const FitOptions&, bool logarithms,
                     const std::vector<double>& stops = {});

/// The indices of the rows of a run that are among these.
Rows shift_rows(const FitRun&, const FitOptions&, bool logarithms,
                double stop = std::numeric_limits<double>::infinity());

/// The least-squares problem of a law and these rows.
System system_of(std::shared_ptr<const ShiftRows>, const Parameters&);

/// Unweighted least squares on D (or the robust loss) for rows whose filters are not known. D
/// and a are in metres, v in m/s; runs that roll towards falling x are reflected. Throws Error if
/// the rows do not determine the parameters.
Fitted fit_shift(const std::vector<FitRun>&, const FitOptions&);

/// The log-log regression line of ln D on ln v through all rows with v > 0 and D > 0, with equal
/// weights, as one would draw it through a plot. If the filters are known (`responses`), the errors
/// are those of the noise of the raw column, propagated through the filters and the logarithms, and
/// the expected bias of the line is reported. Throws Error if the rows do not determine the
/// parameters.
Fitted fit_log_log(const std::vector<FitRun>&, const FitOptions&, std::vector<Response> responses);

}  // namespace rolling
