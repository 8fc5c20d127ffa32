// SPDX-License-Identifier: GPL-3.0-or-later
// The starting point for the fit of a roll.
#pragma once

#include "fit/model_roll.h"

namespace rolling {

struct FirstGuess {
  Parameters parameters;  ///< with units v_ref and x_ref that suit the data
  std::vector<double> theta;
  std::vector<std::vector<double>> others = {};  ///< where a robust search may start as well
};

/// Estimates theta from unfiltered runs (without H) of positions or speeds. Throws Error if the
/// body does not move or if no law comes near the data.
FirstGuess first_guess(const std::vector<ObservedRun>&, const FitOptions&);

/// The runs averaged to at most 4096 block means each; their minimum is very close to that of all
/// rows. Empty if the runs have 4096 rows or fewer on average. The runs must have no H.
std::vector<ObservedRun> means_of_many(const std::vector<ObservedRun>&);

/// Runs without filters that come near to filtered ones: up to 256 positions of each run (for the
/// route position) or speeds, on that polynomial in time whose filtered values have the least
/// weighted sum of squares. It has up to seven terms, fewer for less than 18 rows.
/// (An integral of filtered slopes would not do: where times are uneven, means of slopes do not
/// telescope, and the noise of the integral is a random walk that hides even the direction.)
std::vector<ObservedRun> smooth_motion(Route, const std::vector<ObservedRun>&, const Noise&,
                                       const FitOptions&);

}  // namespace rolling
