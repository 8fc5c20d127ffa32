// The law D = a v^b itself as a model of the records (v, D), and the straight line of their
// logarithms.
#pragma once

#include "fit/fitted.h"

namespace rolling {

/// Least squares on D, of which no filter is known.
Fitted fit_shift(const std::vector<FitRun>&, const FitOptions&);

/// The line of ln D on ln v through all records with v > 0 and D > 0, each with the same weight, as
/// it is drawn through a plot. With known filters its errors are those of the noise of the raw
/// column, carried through the filters and the logarithms.
Fitted fit_log_log(const std::vector<FitRun>&, const FitOptions&);

}  // namespace rolling
