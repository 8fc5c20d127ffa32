// The derivative of the cubic smoothing spline: the natural spline that minimises the squared
// residuals plus a parameter times the integral of its squared second derivative (Reinsch 1967,
// Numer. Math. 10, 177). It needs the whole run.
#pragma once

#include "signal/signal.h"

namespace rolling {

/// The parameter is that of least generalised cross-validation (Craven and Wahba 1979, Numer. Math.
/// 31, 377), with every degree of freedom counted 1.4 times (Kim and Gu 2004, J. R. Statist. Soc. B
/// 66, 337): counted once, as it was at first, now and then next to nothing is smoothed, and always
/// where the noise of neighbours is bound. Each trial takes O(n) (Hutchinson and de Hoog 1985,
/// Numer. Math. 47, 99).
class SplineDerivative : public Signal {
 public:
  std::span<const double> push(double t, double y) override;
  /// Throws Error for a run of one sample.
  std::span<const double> finish() override;

 private:
  double solve(double parameter);

  std::vector<double> t_, y_, slopes_;
  std::vector<double> h_;                  // steps, in units of their mean
  std::vector<double> qy_, q0_, q1_, q2_;  // Q^T y, and the bands of Q^T Q
  std::vector<double> D_, L1_, L2_,
      bend_;  // B = R + parameter Q^T Q = L D L^T; the spline's second derivatives
};

}  // namespace rolling
