// Is D = a v^b the right law? The polynomials of coast-down tests on the same records, compared by
// AICc.
#pragma once

#include "fit/fit.h"

namespace rolling {

/// How well a law describes the records of a route, by AICc (Burnham and Anderson 2002, Model
/// Selection and Multimodel Inference): smaller is better, differences below 2 say nothing.
/// Infinite where the law cannot be fitted.
struct LawScore {
  const char* law;
  double aicc;
  bool is_power = false;  ///< a v^b itself, or a special case of it: no evidence against it
};

/// D = a v^b first, then the coast-down laws D = d0, d0 + d1 v, d0 + d1 v + d2 v^2 on the same
/// records with the same weights (A = 1). Records with correlated residuals count as
/// n (1 - r)/(1 + r) independent ones, r their correlation from one to the next: so much less does
/// the mean of an AR(1) process tell (Bayley and Hammersley 1946, J. R. Stat. Soc. Suppl. 8, 184).
std::vector<LawScore> compare_laws(Route, const std::vector<FitRun>&, const FitOptions&);

}  // namespace rolling
