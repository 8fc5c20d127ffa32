// Is D = a v^b the right law? Other laws on the same records, compared by AICc.
#pragma once

#include <vector>

#include "base/estimate.h"
#include "contact/law.h"
#include "fit/fit.h"

namespace rolling {

/// What the records of a route say of a law.
struct LawFit {
  const Law* law;
  /// Akaike's criterion (Burnham and Anderson 2002, Model Selection and Multimodel Inference):
  /// smaller is better, differences below 2 say nothing. Infinite where the law cannot be fitted.
  double aicc;
  std::vector<Estimate> coefficients;  ///< in SI units; none where the law cannot be fitted
  std::vector<double> correlations;    ///< of each two of them, row by row
};

/// Of each law of contact/law.h, a v^b first.
struct LawComparison {
  std::vector<LawFit> fits;

  double least() const;  ///< AICc of the best one
  /// The best law that is no a v^b and no special case of it: those are no evidence against it.
  const LawFit& best_other() const;
  /// By how much the AICc of a v^b is above that of best_other(); negative where it is below.
  double against_power() const;
  /// Infinite where nothing can be compared: there are too few independent records.
  bool possible() const;
};

/// Fits every law to the same records with the same weights as fit() fits a v^b, a roll where that
/// is a roll. Records with correlated residuals count as n (1 - r)/(1 + r) independent ones, r
/// their correlation from one to the next under the law that leaves least of it: so much less does
/// the mean of an AR(1) process tell (Bayley and Hammersley 1946, J. R. Stat. Soc. Suppl. 8, 184).
/// For loglog the laws are compared on D itself, as for shift.
/// Throws Error for a robust fit.
LawComparison compare_laws(Route, const std::vector<FitRun>&, const FitOptions&);

}  // namespace rolling
