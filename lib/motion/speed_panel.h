// The integrals over speed of D(v) = a v^b in the exact geometry, by quadrature over a short range.
#pragma once

#include "motion/speed_arm.h"
#include "motion/wanted.h"

namespace rolling {

/// The range from < ln(v0/u) < from + width, by the Gauss-Legendre rule of 16 points. For b != 0.
///
/// Here y counts from the beginning of the range, and the speed there is the unit of speed: the
/// integrals are those of a roll that begins there. The variable of integration is A,
/// dy = A dA / (b z), which removes the square root of A and the pole of 1/A at D = R. Where z
/// changes by at most a factor 2 over the range and e^(-s y), s = 1 - b, by a factor e, the
/// relative error of the rule is below 1e-16: the integrand has a pole at z = 0, A = 1, and for D =
/// R at the beginning, the worst case, A runs from 0 to 0.7. The ellipse about this range through
/// the pole has semi-axes of the sum 3.4 in half ranges, and 3.4^-32 = 1e-17.
class SpeedPanel {
 public:
  SpeedPanel(const SpeedArm& arm, double from, double width)
      : arm_(arm), from_(from), width_(width), z_(arm.z(from)), A_(arm.A(from)) {}

  double time(double y) const;      ///< int_0^y f e^(-s u) du
  double lag(double y) const;       ///< int_0^y (1 - f) e^(-s u) du
  double distance(double y) const;  ///< int_0^y f e^(-(s+1) u) du
  SpeedGradient gradient(double y, Wanted) const;
  /// The y with time(y) = time. `rest`, the time from there to the stop, is not needed.
  double lambda(double time, double rest) const;

 private:
  template <typename Integrand>
  void quadrature(double y, Integrand&&) const;

  SpeedArm arm_;
  double from_, width_, z_, A_;
};

}  // namespace rolling
