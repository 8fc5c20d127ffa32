#include "contact/contact.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace rolling {

Incline incline(const Body& c) {
  if (c.slope == 0) return {1, 0};
  const double hypotenuse = std::hypot(1, c.slope);
  return {1 / hypotenuse, c.slope / hypotenuse};
}

void check_shift(const Body& c, double D) {
  if (!(std::abs(D) <= c.R)) fail("the shift D = {:.6g} m is beyond the radius {:.6g} m", D, c.R);
}

double arm_factor(const Body& c, Geometry geometry, double D) {
  return geometry == Geometry::approximate ? 1 : std::sqrt((1 - D / c.R) * (1 + D / c.R));
}

double horizontal_force(const Body& c, Geometry geometry, double D) {
  return -D * c.m * c.g / ((c.K + arm_factor(c, geometry, D)) * c.R);
}

double torque_of_horizontal_force(const Body& c, Geometry geometry, double D) {
  return -arm_factor(c, geometry, D) * c.R * horizontal_force(c, geometry, D);
}

double torque_of_normal_force(const Body& c, double D) { return -D * c.m * c.g; }

// Both functions below subtract from 0 where a sign would do: no shift then gives +0, and nobody
// reads "-0" in a table.

double acceleration_from_shift(const Body& c, Geometry geometry, double D) {
  check_shift(c, D);
  const auto [cos, sin] = incline(c);
  const double A = arm_factor(c, geometry, D);
  return 0 - c.g * (D * cos + A * c.R * sin) / ((c.K + A) * c.R);
}

double shift_from_acceleration(const Body& c, Geometry geometry, double a) {
  const double K = c.K, s = 0 - a / c.g;
  if (geometry == Geometry::approximate) {
    const double D = (1 + K) * c.R * s;
    check_shift(c, D);
    return D;
  }
  // Eq. 9 is D/R = s (K + A). At |D| = R, where A = 0, |s| = 1/K. Beyond that the root would need A
  // < 0, and comes back below R: |D| > R cannot be what tells it.
  if (!(K * std::abs(s) <= 1))
    fail(
        "no shift D within the radius {:.6g} m gives the acceleration {:.6g} m/s^2: the largest is "
        "{:.6g} m/s^2",
        c.R, a, c.g / K);
  const double r = 1 / s, q = (1 - K) * (1 + K);
  const double d = std::abs(s) <= 1 ? s * (K + std::sqrt(1 + s * s * q)) / (1 + s * s)
                                    : (K * r + std::copysign(std::sqrt(r * r + q), s)) /
                                          (r * r + 1);  // s^2 may overflow
  return c.R * std::clamp(d, -1.0, 1.0);
}

}  // namespace rolling
