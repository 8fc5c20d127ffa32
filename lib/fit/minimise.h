// Nonlinear least squares to round-off: Levenberg-Marquardt, finished by Gauss-Newton steps, each
// from a QR decomposition of the Jacobian.
#pragma once

#include "fit/system.h"

namespace rolling {

struct Minimum {
  std::vector<double> theta, f;
  std::vector<double> R;  ///< J = Q R for the columns of each run: as many upper triangles, row by
                          ///< row, whose shared part is the same
  double rss;
};

/// Throws Error if there is no convergence, or if the parameters cannot be told apart.
Minimum minimise(const System&, const std::vector<double>& start);

/// theta of the minimum of a system that stands in for a larger one; the start if it has none.
std::vector<double> approach(const System&, std::vector<double> start);

/// minimise() with Tukey's bisquare loss (constant 4.685: 95 % efficiency for normal noise) by
/// reweighting, from Huber's (1.345, the same efficiency) on the way; the scale is the median
/// absolute deviation of the residuals. What comes back are pseudo-residuals f (Huber 1981, Robust
/// Statistics, section 7.6) with the unweighted R, so that the errors of least squares made from
/// them are those of the robust fit. The residuals must be those of single records: no correlated
/// noise.
Minimum minimise_robust(const System&, const std::vector<double>& start);

/// ln of the restricted likelihood (Patterson and Thompson 1971, Biometrika 58, 545) of residuals
/// that are normal and white, up to a constant, in the linear approximation around theta:
/// -(n - p)/2 ln RSS - ln |det R|, J = Q R.
double restricted_likelihood(const System&, const std::vector<double>& theta);

}  // namespace rolling
