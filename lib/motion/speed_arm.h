// The arm factor of the contact force along a roll under D(v) = a v^b, and the integrals that
// contain it.
#pragma once

#include <algorithm>
#include <cmath>

namespace rolling {

/// At the speed u, with y = ln(v0/u):
///   z = (D/R)^2 = depth^2 e^(-2 b y),   A = sqrt(1 - z) (Eq. 8),   f = (K + A) / (K + 1).
/// depth is D(v0)/R. arm_square is 1 - depth^2, which the caller may know without cancellation.
struct SpeedArm {
  double b, K, depth, arm_square;

  double z(double y) const { return depth * depth * std::exp(-2 * b * y); }
  double A(double y) const {
    return std::sqrt(std::max(0.0, arm_square - depth * depth * std::expm1(-2 * b * y)));
  }
  double f(double y) const { return depth == 0 ? 1 : (K + A(y)) / (K + 1); }
};

/// Integrals over 0 < y < lambda from which the derivatives of time and distance follow. With s = 1
/// - b and h = (K + 1/A) / (K + 1); h replaces f when u^-b f / a is differentiated with respect to
/// a or b:
struct SpeedGradient {
  double h0 = 0, h1 = 0;  ///< of h e^(-s y), and with a factor y
  double distance = 0;    ///< of f e^(-(s+1) y)
  double g0 = 0, g1 = 0;  ///< of h (e^-y - e^-lambda) e^(-s y), and with a factor y
};

}  // namespace rolling
