// SPDX-License-Identifier: GPL-3.0-or-later
// The derivative of the cubic smoothing spline: the natural spline that minimises the residual sum
// of squares plus a parameter times the integral of the squared second derivative (Reinsch 1967,
// Numer. Math. 10, 177). It needs the whole run.
#pragma once

#include "signal/signal.h"

namespace rolling {

/// The parameter minimises generalised cross-validation (Craven and Wahba 1979, Numer. Math. 31,
/// 377) in which each degree of freedom counts 1.4 times (Kim and Gu 2004, J. R. Statist. Soc. B
/// 66, 337). With the original factor 1 the spline is sometimes hardly smoothed, and always so if
/// the noise of neighbours is correlated. Each trial costs O(n) (Hutchinson and de Hoog 1985,
/// Numer. Math. 47, 99).
class SplineDerivative : public Signal {
 public:
  std::span<const double> push(double t, double y) override {
    run_.push_back({t, y});
    return {};
  }
  /// Throws Error for a run of one sample.
  std::span<const double> finish() override;

 private:
  double solve(double alpha);
  double Qg(std::size_t i) const;

  std::vector<Sample> run_;
  std::vector<double> slopes_;
  std::vector<double> h_;                  // time steps in units of their mean
  std::vector<double> qy_, q0_, q1_, q2_;  // Q^T y, and the bands of Q^T Q (Green and Silverman)
  std::vector<double> D_, L1_, L2_;        // B = R + alpha Q^T Q = L D L^T
  std::vector<double> g_;  // the spline's second derivatives; 0 at both ends, and behind
};

}  // namespace rolling
