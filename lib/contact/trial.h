// SPDX-License-Identifier: GPL-3.0-or-later
// dv/dt for the trial steps of a solver, which may lead to states that the body cannot have.
#pragma once

#include <algorithm>
#include <cmath>

#include "contact/contact.h"

namespace rolling {

/// dv/dt [m/s^2] as in acceleration_from_shift() (Eq. 12), but continued beyond |D| = R with A = 0
/// instead of throwing: the error control of the solver then rejects the step.
inline double trial_acceleration(const Body& c, Geometry geometry, double D) {
  const auto [cos, sin] = incline(c);
  const double d = D / c.R,
               A = geometry == Geometry::exact ? std::sqrt(std::max(0.0, 1 - d * d)) : 1;
  return -c.g * (d * cos + A * sin) / (c.K + A);
}

/// Its derivative by D [1/s^2].
inline double trial_acceleration_slope(const Body& c, Geometry geometry, double D) {
  const auto [cos, sin] = incline(c);
  if (geometry == Geometry::approximate) return -c.g * cos / ((c.K + 1) * c.R);
  // of (d cos + A sin) / (K + A) by d, with dA/dd = -d/A
  const double d = D / c.R, A = std::sqrt(std::max(1e-30, 1 - d * d));
  return -c.g / c.R * (cos * (c.K + A) + d / A * (d * cos - c.K * sin)) / ((c.K + A) * (c.K + A));
}

}  // namespace rolling
