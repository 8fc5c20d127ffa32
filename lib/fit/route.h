// SPDX-License-Identifier: GPL-3.0-or-later
// The route of a fit, from the columns of the runs to a minimum.
#pragma once

#include "fit/fitted.h"

namespace rolling {

/// Fits by one route, without the errors. Throws Error as fit() does, except for the limits on the
/// standard errors.
Fitted fit_route(Route, const std::vector<FitRun>&, const FitOptions&);

}  // namespace rolling
