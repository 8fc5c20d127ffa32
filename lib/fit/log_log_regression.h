// SPDX-License-Identifier: GPL-3.0-or-later
// The straight line through the logarithms of the rows (v, D).
#pragma once

#include "fit/fitted.h"

namespace rolling {

/// The log-log regression line of ln D on ln v through all rows with v > 0 and D > 0, with equal
/// weights, as one would draw it through a plot. If the filters are known (`responses`), the errors
/// are those of the noise of the raw column, propagated through the filters and the logarithms, and
/// the expected bias of the line is reported. Throws Error if the rows do not determine the
/// parameters.
Fitted fit_log_log(const std::vector<FitRun>&, const FitOptions&, std::vector<Response> responses);

}  // namespace rolling
