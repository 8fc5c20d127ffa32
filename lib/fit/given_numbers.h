// What the uncertainties of the numbers that are given, K, R, g and the slope, bring to a fit.
#pragma once

#include "fit/fitted.h"

namespace rolling {

/// By how much one standard uncertainty of a given number moves what is fitted.
struct Moved {
  std::string by;  ///< "K", or "K 0.5" where the runs have several
  double a, b, slope;
  std::vector<double> v0;  ///< of each run
};

/// One for each number that is given with an uncertainty. Runs that state the same number with the
/// same uncertainty are runs of the same body: it moves them together. The records are fitted again
/// with the number a standard uncertainty (or a tenth of the number, if that is less) above and
/// below; on the routes by D, whose D was made with these numbers, with the D that the same
/// accelerations give then.
std::vector<Moved> moved_by_given(Route, const std::vector<FitRun>&, const FitOptions&,
                                  const Fitted&);

}  // namespace rolling
