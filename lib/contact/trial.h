// What a solver may try on its way is not yet a state of the body.
#pragma once

#include "contact/body.h"

#include <algorithm>
#include <cmath>

namespace rolling {

/// dv/dt [m/s^2] as acceleration_from_shift() has it (Eq. 12), and continued beyond |D| = R, where
/// A = 0: a step that went too far is rejected for its error, not refused.
inline double trial_acceleration(const Body& c, Geometry geometry, double D) {
  const double d = D / c.R,
               A = geometry == Geometry::exact ? std::sqrt(std::max(0.0, 1 - d * d)) : 1;
  return -c.g * d / (c.K + A);
}

/// Its derivative by D [1/s^2].
inline double trial_acceleration_slope(const Body& c, Geometry geometry, double D) {
  if (geometry == Geometry::approximate) return -c.g / ((c.K + 1) * c.R);
  const double d = D / c.R, A = std::sqrt(std::max(
                                1e-30, 1 - d * d));  // -d/dd of d / (K + A), with dA/dd = -d/A
  return -c.g / c.R * ((c.K + A) + d * d / A) / ((c.K + A) * (c.K + A));
}

}  // namespace rolling
