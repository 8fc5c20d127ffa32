// SPDX-License-Identifier: GPL-3.0-or-later
// The motion behind filtered rows, before any law is known.
#pragma once

#include "fit/model_roll.h"

namespace rolling {

/// Runs without filters that come near to filtered ones: up to 256 positions of each run (for the
/// route position) or speeds, on that polynomial in time whose filtered values have the least
/// weighted sum of squares. It has up to seven terms, fewer for less than 18 rows.
/// (An integral of filtered slopes would not do: where times are uneven, means of slopes do not
/// telescope, and the noise of the integral is a random walk that hides even the direction.)
std::vector<ObservedRun> smooth_motion(Route, const std::vector<ObservedRun>&, const Noise&,
                                       const FitOptions&);

}  // namespace rolling
