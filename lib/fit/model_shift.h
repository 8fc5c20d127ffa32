// SPDX-License-Identifier: GPL-3.0-or-later
// The law D = a v^b as a model of the rows (v, D).
#pragma once

#include "fit/fitted.h"

namespace rolling {

/// Unweighted least squares on D (or the robust loss) for rows whose filters are not known. D
/// and a are in metres, v in m/s; runs that roll towards falling x are reflected. Throws Error if
/// the rows do not determine the parameters.
Fitted fit_shift(const std::vector<FitRun>&, const FitOptions&);

}  // namespace rolling
