// The law D = a v^b as a model of the records (v, D), and the straight line through their
// logarithms.
#pragma once

#include "fit/fitted.h"

namespace rolling {

/// Unweighted least squares on D (or the robust loss) for records whose filters are not known. D
/// and a are in metres, v in m/s; runs that roll towards falling x are reflected. Throws Error if
/// the records do not determine the parameters.
Fitted fit_shift(const std::vector<FitRun>&, const FitOptions&);

/// The log-log regression line of ln D on ln v through all records with v > 0 and D > 0, with equal
/// weights, as one would draw it through a plot. If the filters are known, the errors are those of
/// the noise of the raw column, propagated through the filters and the logarithms, and the expected
/// bias of the line is reported. Throws Error if the records do not determine the parameters.
Fitted fit_log_log(const std::vector<FitRun>&, const FitOptions&);

}  // namespace rolling
