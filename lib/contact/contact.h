// Forces, torques and the shift of the contact force (Eqs. 3 to 12). D and v point forward; a force
// is positive forward, a torque positive when it spins the body up in forward rolling.
#pragma once

#include "contact/body.h"

namespace rolling {

/// The parts of gravity across the mat (cos theta) and along it (sin theta), tan theta = slope.
struct Incline {
  double cos, sin;
};
Incline incline(const Body&);

/// Throws Error when |D| > R: no point of the body is there.
void check_shift(const Body&, double D);

/// A = sqrt(1 - D^2/R^2) (Eq. 8), or 1 in the approximate geometry. Needs |D| <= R.
double arm_factor(const Body&, Geometry, double D);

/// F_H = -D m g / ((K + A) R) [N] (Eq. 9).
double horizontal_force(const Body&, Geometry, double D);

/// tau_H = -A R F_H [N m] (Eq. 6).
double torque_of_horizontal_force(const Body&, Geometry, double D);

/// tau_N = -D m g [N m] (Eq. 7).
double torque_of_normal_force(const Body&, double D);

/// Acceleration [m/s^2] that a shift D [m] causes: -g (D cos + A R sin) / ((K + A) R), Eq. 12 for
/// a level mat. Throws Error when |D| > R.
double acceleration_from_shift(const Body&, Geometry, double D);

/// Shift D [m] from an observed acceleration [m/s^2]: (1 + K) R s with s = -a/g (Eq. 11), or the
/// exact root of Eq. 9, D/R = s (K + sqrt(1 + s^2 (1 - K^2))) / (1 + s^2). a > 0 gives D < 0; that
/// is reported, not clipped. Throws Error when |D| > R, in either geometry. The exact geometry has
/// no shift at all for |a| > g/K (A would be negative).
double shift_from_acceleration(const Body&, Geometry, double a);

}  // namespace rolling
