// SPDX-License-Identifier: GPL-3.0-or-later
// What the noise of the rows of a fit does to its numbers. It asks for no other fit: the routes may
// include it.
#pragma once

#include "fit/fitted.h"
#include "fit/result.h"

namespace rolling {

/// What the noise of a fit does to its numbers.
struct Uncertainty {
  Errors kind;
  double whiteness;   ///< as in FitResult
  Matrix covariance;  ///< of Fitted::numbers(); 0 for one that is fixed
};

/// Q = J R^-1 at the minimum. Its columns are orthonormal.
Matrix orthonormal(const System&, const Minimum&);

/// The noise that the residuals of a fit with this Q show; of a log-log line behind known filters,
/// that of the roll that made its rows.
SeenNoise seen_noise(const Fitted&, Matrix Q);

/// The covariance of a fit, R^-1 M R^-T, where M is the covariance of Q^T e and e is the noise of
/// the residuals. (It is called a sandwich estimator, and M its meat.) For known filters it is
/// exact, otherwise the classical s^2 (J^T J)^-1. With levels::least_tested rows the noise is
/// tested (for known filters the noise of the raw column). If it is not white (Ljung and Box), the
/// covariance is that of Newey and West, already at 17 % if neighbouring residuals are positively
/// correlated; otherwise, if the variance is uneven at 1 %, along the runs or between them, it is
/// HC3.
Uncertainty uncertainty_of(const Fitted&, Matrix Q);
inline Uncertainty uncertainty_of(const Fitted& fit) {
  return uncertainty_of(fit, orthonormal(fit.system(), fit.minimum));
}

/// The mean variance that the rounding of the readings leaves them; 0 behind filters. Gates fix x
/// or v, and t is measured: readings are not rounded if they are on a grid, far closer to the roll
/// than rounding would leave them, none repeats, and their times are not those of a clock.
double variance_of_rounding(const Fitted&);

/// The correlations of the first n numbers; 0 where a variance is 0, as that of a number that is
/// fixed.
Matrix correlations_of(const Matrix& covariance, std::size_t n);

}  // namespace rolling
