// SPDX-License-Identifier: GPL-3.0-or-later
// Comparison of the power law D = a v^b with other laws on the same rows by AICc.
#pragma once

#include <cmath>
#include <vector>

#include "base/estimate.h"
#include "base/matrix.h"
#include "contact/law.h"
#include "fit/input.h"

namespace rolling {

/// The fit of one law to the rows of a route.
struct LawFit {
  const LawForm* law;
  /// The corrected Akaike information criterion (Burnham and Anderson 2002, Model Selection and
  /// Multimodel Inference). Smaller is better; a difference below 2 says nothing. Infinite if
  /// the law cannot be fitted.
  double aicc = INFINITY;
  std::vector<Estimate> coefficients = {};  ///< in SI units; empty if the law cannot be fitted
  Matrix correlations = {};
};

/// The fits of all laws of contact/law.h, a v^b first.
struct LawComparison {
  std::vector<LawFit> fits;
  /// The best law beside the one that was asked for (FitOptions::law), in `fits`; a special case of
  /// a v^b is no evidence against that.
  const LawForm* other = nullptr;
  /// AICc of the one that was asked for minus that of the other; NaN if there are too few
  /// independent rows for the AICc of two laws.
  double against = NAN;
};

struct Fitted;

/// The fit of this law, which is another one, to the rows, with the weights, of a fit of a v^b.
/// Throws Error if the rows do not determine it.
Fitted fit_of_law(const Fitted& power, const LawForm&);

/// Fits every law to the same rows with the same weights that fit() uses for a v^b; the model is
/// a roll on the routes where fit() uses a roll. Correlated residuals count as n (1 - r)/(1 + r)
/// independent rows, with r the lag-1 autocorrelation under the law that leaves the least; this
/// is the number for the mean of an AR(1) process (Bayley and Hammersley 1946, J. R. Stat. Soc.
/// Suppl. 8, 184). For loglog the laws are compared on D itself, as for shift. Of more than 4096
/// rows a run block means are compared (of_means()). Throws Error for a robust fit, and if the
/// fit of a v^b itself is not possible.
LawComparison compare_laws(Route, const std::vector<FitRun>&, FitOptions);

}  // namespace rolling
