// SPDX-License-Identifier: GPL-3.0-or-later
// The fit of a law D(v) to rows by one of four routes, and the comparison of laws by AICc.
#pragma once

#include <cmath>
#include <vector>

#include "base/estimate.h"
#include "base/matrix.h"
#include "fit/input.h"
#include "fit/result.h"

namespace rolling {

/// Fits all runs jointly: a and b are common to the runs, v0 and x0 belong to each run. Where the
/// runs disagree, a and b are the means of the runs' own values (refits.h). Throws Error with a
/// one-line message if the data do not determine the result: too few rows, all v equal, no
/// positive D (loglog), no convergence, a standard error of b above 3, a slope that cannot be
/// separated from a.
FitResult fit(Route, const std::vector<Run>&, const FitOptions&);

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

/// The fits of all laws of law/law.h, a v^b first.
struct LawComparison {
  std::vector<LawFit> fits;
  /// The best law beside the one that was asked for (FitOptions::law), in `fits`; a special case of
  /// a v^b is no evidence against that.
  const LawForm* other = nullptr;
  /// AICc of the one that was asked for minus that of the other; NaN if there are too few
  /// independent rows for the AICc of two laws.
  double against = NAN;
};

/// Fits every law to the same rows with the same weights that fit() uses for a v^b; the model is
/// a roll on the routes where fit() uses a roll. Correlated residuals count as n (1 - r)/(1 + r)
/// independent rows, with r the lag-1 autocorrelation under the law that leaves the least; this
/// is the number for the mean of an AR(1) process (Bayley and Hammersley 1946, J. R. Stat. Soc.
/// Suppl. 8, 184). For loglog the laws are compared on D itself, as for shift. Of more than 4096
/// rows a run block means are compared (of_means()). Throws Error for a robust fit, and if the
/// fit of a v^b itself is not possible.
LawComparison compare_laws(Route, const std::vector<Run>&, FitOptions);

}  // namespace rolling
