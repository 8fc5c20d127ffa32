// Does the body roll freely from the first record on?
#pragma once

#include <optional>

#include "fit/fit.h"

namespace rolling {

/// The first records of a run do not go on as the others: a hand that is still on, or a slide.
struct Beginning {
  std::size_t run;      ///< counted from 0
  std::size_t records;  ///< so many at its beginning
  double time;          ///< from the first of them to the first behind them [s]
  double significance;  ///< the chance of such records, from noise alone
};

/// Chow's predictive test (1960, Econometrica 28, 591): are the first 3, 5, 8, 13, ... records of a
/// run (at most a quarter of it) where the others say, by the F of the squares that go with them?
/// The run that shows it most clearly, where the chance is below 0.1 % after Bonferroni, and the
/// other records are white: noise of long memory would show everywhere.
///
/// None for a fit of no roll, of less than 20 records more than parameters, or of columns that
/// known filters have made: whatever is wrong at the beginning of those spreads over all the
/// residuals, which then are not white. Throws Error where fit() would.
std::optional<Beginning> disturbed_beginning(Route, const std::vector<FitRun>&, const FitOptions&);

}  // namespace rolling
