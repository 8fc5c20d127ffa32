// SPDX-License-Identifier: GPL-3.0-or-later
// Fits of rolls: positions, speeds, and shifts whose filters are known.
#pragma once

#include "fit/fitted.h"

namespace rolling {

/// The starting point for the fit of a roll.
struct FirstGuess {
  Parameters parameters;  ///< with units v_ref and x_ref that suit the data
  /// theta; behind it others where a robust search may start as well.
  std::vector<std::vector<double>> starts;
};

/// Estimates theta from positions or speeds as if they were not filtered (without H). Throws Error
/// if the body does not move or if no law comes near the data.
FirstGuess first_guess(const std::vector<ObservedRun>&, const FitOptions&);

/// The rows of each run in which no reading is missing: those with finite values. For a roll under
/// shifts a row with v <= 0 counts too: to select by noisy speeds would be to select by their
/// noise.
std::vector<Rows> usable(Route, const std::vector<FitRun>&);

/// Fits a roll: position, velocity, and shift with known filters (`responses`).
Fitted fit_rolls(Route, const std::vector<FitRun>&, std::vector<Rows>, std::vector<Response>,
                 const FitOptions&, AddedNoise = {});

/// The fit of these runs with the weights of this noise.
Fitted fit_from(const FirstGuess&, std::vector<ObservedRun>, std::shared_ptr<const Noise>,
                const FitOptions&);

/// Fits one run of a joint fit of rolls separately: the same rows and weights, the slope of the
/// mat fixed at the joint value. Throws Error if the run does not determine its parameters, or has
/// none.
Fitted fit_of_run(const Fitted& joint, std::size_t run, const FitOptions&);

/// The fit of block means of equal size, at most 4096 of each run, where there are more rows than
/// that on average and no filter is known; otherwise the fit itself. The means hold what a smooth
/// law can tell.
Fitted of_means(Fitted, const FitOptions&);

/// The sum of squares of model - data in the unit of the fitted column, without weights.
double sum_of_squares(const Fitted&);

}  // namespace rolling
