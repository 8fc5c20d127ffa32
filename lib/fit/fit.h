// SPDX-License-Identifier: GPL-3.0-or-later
// The fit of a law D(v) to rows by one of four routes.
#pragma once

#include "fit/input.h"
#include "fit/result.h"

namespace rolling {

/// Fits all runs jointly: a and b are common to the runs, v0 and x0 belong to each run. Where the
/// runs disagree, a and b are the means of the runs' own values (agreement.h). Throws Error with a
/// one-line message if the data do not determine the result: too few rows, all v equal, no
/// positive D (loglog), no convergence, a standard error of b above 3, a slope that cannot be
/// separated from a.
FitResult fit(Route, const std::vector<FitRun>&, const FitOptions&);

}  // namespace rolling
