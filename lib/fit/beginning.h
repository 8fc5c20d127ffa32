// SPDX-License-Identifier: GPL-3.0-or-later
// A test whether the body rolls freely from the first row on.
#pragma once

#include <optional>

#include "fit/input.h"

namespace rolling {

/// A disturbed beginning: the first rows of a run do not follow the motion of the other ones,
/// because of a hand that still pushes or of sliding.
struct Beginning {
  std::size_t run;   ///< the number of the run, from 0
  std::size_t rows;  ///< number of disturbed rows
  double time;       ///< from the first disturbed row to the first undisturbed one [s]
  double p;          ///< the probability that noise alone gives such rows
};

/// Chow's predictive test (1960, Econometrica 28, 591) asks whether the first 3, 5, 8, 13, ...
/// rows of a run (at most a quarter of it) agree with the prediction from the others. Each run
/// is fitted by itself (the slope of the mat fixed at that of all), as the law of a joint fit has
/// errors from the noise of the other runs, which may be larger. The statistic is the F ratio of
/// the reduction of the sum of squares that their removal causes to the variance of the noise: that
/// of the other residuals, or of the first k + 5 by their second differences where that is larger.
/// (The noise may differ along a run; the deviation that a hand leaves is smooth.) The result is
/// the run with the smallest p, if this is below 0.1 % after Bonferroni's correction and
/// the other residuals of that run are white: noise of long memory would deviate everywhere.
///
/// Runs of fewer than 20 rows more than parameters are left out. The result is empty for a
/// robust fit and one that is not a roll, and for filtered columns: filters spread a disturbance
/// over all residuals, which then are not white. Throws Error if the joint fit is not possible.
std::optional<Beginning> disturbed_beginning(Route, const std::vector<FitRun>&, const FitOptions&);

}  // namespace rolling
