// SPDX-License-Identifier: GPL-3.0-or-later
// The standard errors of a fit that come from the noise of its rows.
#pragma once

#include "fit/fitted.h"
#include "fit/result.h"

namespace rolling {

/// The sandwich covariance R^-1 M R^-T of the parameters of each run together with the shared ones.
/// M is the meat of the sandwich.
class Spread {
 public:
  Spread(std::vector<double> R, std::vector<double> M, std::size_t columns)
      : R_(std::move(R)), M_(std::move(M)), q_(columns) {}
  /// The covariance of two functions of the parameters of a run, given by their gradients.
  double operator()(std::vector<double> g, std::vector<double> h, std::size_t run = 0) const;

 private:
  std::vector<double> R_, M_;
  std::size_t q_;
};

struct Uncertainty {
  Errors kind;
  double whiteness;  ///< as in FitResult
  double variance;   ///< variance of the noise: of the raw column if the filters are known
  Spread covariance;
};

/// The noise that the residuals of a fit show; of a log-log line behind known filters, that of the
/// roll that made its rows.
SeenNoise seen_noise(const Fitted&);
/// The same of the sources before the filters that are known (`filtered`), or of the residuals.
SeenNoise seen_noise(const Fitted&, bool filtered);
/// B^T B of each run for noise with the B of its sources.
std::vector<double> meat_of(const SeenNoise&);

/// The covariance of a fit. For known filters it is the exact sandwich, otherwise the classical s^2
/// (J^T J)^-1. With 30 or more rows the noise is tested (for known filters the noise of the raw
/// column). If it is not white (Ljung and Box), the covariance is that of Newey and West, already
/// at 10 % if neighbouring residuals are positively correlated; otherwise, if the variance is
/// uneven at 1 %, along the runs or between them, it is HC3.
Uncertainty uncertainty_of(const Fitted&);
/// The same with noise that other fits of the same rows have shown.
Uncertainty uncertainty_of(const Fitted&, const SeenNoise&);

/// The mean variance that the rounding of the readings leaves them; 0 behind filters. Gates fix x
/// or v, and t is measured: readings on a grid that are far closer to the roll than rounding would
/// leave them, of which none repeats and whose times are not those of a clock, are not rounded.
double variance_of_rounding(const Fitted&);

/// The standard errors of the reported numbers that are due to the noise.
struct NoiseErrors {
  Errors kind;
  double whiteness;
  ErrorShare share;

  /// Multiplies all standard errors by a factor.
  void multiply(double factor);
};
NoiseErrors noise_errors(const Fitted&, const Uncertainty&);

/// 0 where a variance is 0, as that of a number that is fixed.
Matrix correlations_of(const Matrix& covariance);

/// Q = J R^-1 at the minimum. The meat M of the covariance R^-1 M R^-T is a quadratic form of the
/// rows of Q.
Matrix orthonormal(const Fitted&);

}  // namespace rolling
