// Propagation of the uncertainties of the given numbers (K, R, g and the slope) to the results of a
// fit.
#pragma once

#include "fit/fitted.h"

namespace rolling {

/// The change of each result when a given number changes by one standard uncertainty.
struct Moved {
  std::string by;  ///< the name of the number: "K", or "K 0.5" where the runs have several values
  double a, b, slope;
  std::vector<double> v0;  ///< one for each run
};

/// The changes for each given number with an uncertainty. Runs with the same value and uncertainty
/// have the same body; they change together. The derivative is a central difference of two fits,
/// with the number one standard uncertainty (or a tenth of the number, if that is less) above and
/// below its value. On the routes that read D, which was computed with these numbers, D is computed
/// again from the same accelerations. Throws Error if the fit itself is not possible.
std::vector<Moved> moved_by_given(Route, const std::vector<FitRun>&, const FitOptions&,
                                  const Fitted&);

}  // namespace rolling
