// SPDX-License-Identifier: GPL-3.0-or-later
// Are speeds of unknown origin differences of positions, as the software of a sensor makes them?
#pragma once

#include "fit/fitted.h"

namespace rolling {

/// The velocity fit with the difference filter of options.possible_filters, and the share of white
/// noise, that have the largest restricted likelihood; the likelihood is computed around `plain`, a
/// fit without a filter. None if white noise alone, or a mean of speeds, is nearly as likely or
/// more likely, or if the residuals of the new fit are not white or are uneven along the runs.
std::optional<Fitted> fit_differences(const std::vector<FitRun>&, const FitOptions&,
                                      const Fitted& plain);

}  // namespace rolling
