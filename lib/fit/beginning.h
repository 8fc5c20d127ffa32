// A test whether the body rolls freely from the first record on.
#pragma once

#include <optional>

#include "fit/input.h"

namespace rolling {

/// A disturbed beginning: the first records of a run do not follow the motion of the other ones,
/// because of a hand that still pushes or of sliding.
struct Beginning {
  std::size_t run;      ///< the number of the run, from 0
  std::size_t records;  ///< number of disturbed records
  double time;          ///< from the first disturbed record to the first undisturbed one [s]
  double significance;  ///< the probability that noise alone gives such records
};

/// Chow's predictive test (1960, Econometrica 28, 591) asks whether the first 3, 5, 8, 13, ...
/// records of a run (at most a quarter of it) agree with the prediction from the others. The
/// statistic is the F ratio of the reduction of the sum of squares that their removal causes to the
/// variance of the noise: that of the other residuals of the run, or of the first k + 5 by their
/// second differences where that is larger. (The noise may differ from run to run and along a run;
/// the deviation that a hand leaves is smooth.) The result is the run with the smallest
/// significance, if this is below 0.1 % after Bonferroni's correction and the other residuals of
/// that run are white: noise of long memory would deviate everywhere.
///
/// The result is empty for a robust fit and one that is not a roll, for fewer than 20 records more
/// than parameters, and for filtered columns: filters spread a disturbance over all residuals,
/// which then are not white. Throws Error if the fit itself is not possible.
std::optional<Beginning> disturbed_beginning(Route, const std::vector<FitRun>&, const FitOptions&);

}  // namespace rolling
