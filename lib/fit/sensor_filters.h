// Speeds of which nothing is known may be differences that the program of a sensor made of
// positions.
#pragma once

#include "fit/fitted.h"

namespace rolling {

/// The fit through the positions of which the speeds are most likely differences: by the filter,
/// with some white noise added to what it makes, under which the residuals are most likely around
/// `plain`, a fit that knows of no filter. None if white noise alone is nearly as likely, or if the
/// residuals that it leaves do not look white.
std::optional<Fitted> fit_differences(const std::vector<FitRun>&, const FitOptions&,
                                      const Fitted& plain);

}  // namespace rolling
