// SPDX-License-Identifier: GPL-3.0-or-later
// The rows (v, D) of the routes loglog and shift.
#pragma once

#include <limits>
#include <vector>

#include "fit/fitted.h"

namespace rolling {

/// The rows of a run that the routes loglog and shift use: with finite v > 0 of at least
/// options.min_speed, and with D > 0 if `logarithms`; what is no more than the rounding of a
/// difference (base/grid.h) counts as 0. From the time `stop` on no row is used. A body that rolls
/// towards falling x has v < 0 and D < 0; both are taken positive along its direction of motion.
Rows shift_rows(const FitRun&, const FitOptions&, bool logarithms,
                double stop = std::numeric_limits<double>::infinity());

/// The runs of the columns D [m] or ln D with these rows, without the runs that have none. Throws
/// Error if the rows do not determine the parameters.
std::vector<ObservedRun> observed_shifts(const std::vector<FitRun>&, const std::vector<Rows>&,
                                         const FitOptions&, bool logarithms);

/// The parameters of a law of these runs: the unit of speed is the geometric mean of theirs, where
/// the estimates of ln D and b are uncorrelated.
Parameters parameters_of_shifts(const std::vector<ObservedRun>&, const FitOptions&);

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
