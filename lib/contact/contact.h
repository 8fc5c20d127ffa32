// SPDX-License-Identifier: GPL-3.0-or-later
// The mat's force on the body, and the shift D of the point P where it acts (Eqs. 6 to 12), on a
// mat that may be inclined. D, v and the forces point forward along the mat, a torque is positive
// when it spins the body up in forward rolling.
#pragma once

#include <cmath>

#include "contact/body.h"

namespace rolling {

/// The parts of gravity across the mat (cos theta) and along it (sin theta), tan theta = slope.
struct Incline {
  double cos, tan;
  double sin() const { return cos * tan; }
};
inline Incline incline(const Body& c) {
  return {c.slope == 0 ? 1 : 1 / std::hypot(1, c.slope), c.slope};
}

/// The same on body.road at x, for a body with the speed v: the curvature k, positive in a hollow,
/// adds k v^2/g to cos theta. Throws Error outside of the table, and where the body leaves the
/// track.
Incline incline(const Body&, double x, double v);

/// The body as one sees it who looks along its motion, towards falling x if `way` is -1: slope,
/// wind and road have the other direction then.
Body seen_along(Body, double way);

/// Throws Error if |D| > R, where the body has no point.
void check_shift(const Body&, double D);

/// A = sqrt(1 - D^2/R^2) (Eq. 8) for |D| <= R in the exact geometry, else 1.
double arm_factor(const Body&, double D);

/// The acceleration of a body [m/s^2], and its derivatives by D and by the parts of gravity.
struct Acceleration {
  double a, by_D, by_cos, by_sin;
};
/// Of a body whose mat acts at the shift D [m] (Eq. 12; theta = 0 there):
///     v' = -g (D cos theta + A R sin theta) / ((K + A) R)
/// In the exact geometry it goes on beyond |D| = R with A = 0: the error control of a solver then
/// rejects the step.
Acceleration accelerate(const Body&, double D, const Incline&);
/// The same on the mat of the body.
inline Acceleration accelerate(const Body& c, double D) { return accelerate(c, D, incline(c)); }
/// The first of them. Throws Error when |D| > R.
double acceleration_from_shift(const Body&, double D);

/// Shift D [m] from an observed acceleration a [m/s^2], the inverse of acceleration_from_shift().
/// With A = 1 this is Eq. 11, which gives a shift for any acceleration, beyond the radius too. In
/// the exact geometry there is one shift for |a| <= g cos theta / K; else it throws Error, since
/// there is none, or, on a mat steeper than tan theta = 1/K, perhaps two. A body that speeds up on
/// a level mat has D < 0, which is returned as it is.
double shift_from_acceleration(const Body&, double a);

}  // namespace rolling
