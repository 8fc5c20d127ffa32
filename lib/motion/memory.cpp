// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/memory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/error.h"
#include "contact/contact.h"
#include "motion/roll.h"

namespace rolling {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rest_fraction = 1e-3;  // of v0
constexpr double stiff = 3e4;           // measured: above it an implicit solver is faster

OdeSystem equations(const Body& body, Geometry geometry, PowerLaw law, Bulge bulge, double v0) {
  check_roll(body, law, v0);
  if (law.b < 0)
    fail(
        "the exponent b = {} is negative: a bulge with memory needs a shift that is finite at rest",
        law.b);
  if (!(bulge.length > 0 && std::isfinite(bulge.length)))
    fail("the length of the memory = {} m must be a positive number", bulge.length);
  if (!(bulge.damping >= 0 && std::isfinite(bulge.damping)))
    fail("the damping of the memory = {} s must be a number that is not negative", bulge.damping);
  // y = (x, v, z).
  const auto derivative = [body, geometry, law, bulge](double, const double* y, double* dydt) {
    const double v = y[1], z = y[2];
    dydt[0] = v;
    dydt[2] = std::abs(v) * (law(v) - z) / bulge.length;
    dydt[1] = trial_acceleration(body, geometry, z + bulge.damping * dydt[2]);
  };
  const auto jacobian =
      [body, geometry, law, bulge](double, const double* y, double* dfdy, double* dfdt) {
    const double v = y[1], z = y[2], speed = std::abs(v);
    const double dv_dD = trial_acceleration_slope(
        body, geometry, z + bulge.damping * speed * (law(v) - z) / bulge.length);
    const double dz_dv =
                     ((1 + law.b) * std::abs(law(v)) - std::copysign(1.0, v) * z) / bulge.length,
                 dz_dz = -speed / bulge.length;
    const double rows[9] = {
        0, 1,     0,    0, dv_dD * bulge.damping * dz_dv, dv_dD * (1 + bulge.damping * dz_dz),
        0, dz_dv, dz_dz};
    std::copy(rows, rows + 9, dfdy);
    dfdt[0] = dfdt[1] = dfdt[2] = 0;
  };
  return {derivative, jacobian};
}

}  // namespace

Stepper memory_stepper(const Body& body, PowerLaw law, Bulge bulge, double v0) {
  // With z near the law, the shift z + damping z' of a body that slows down is smaller than z, by
  // the factor 1 + damping c dD/dv.
  const double q = std::abs(trial_acceleration(body, Geometry::approximate, law(v0))),
               slowing = v0 / q + bulge.damping * law.b,
               following = bulge.length / (v0 + bulge.damping * q);
  return slowing > stiff * following ? Stepper::rk4imp : Stepper::rk8pd;
}

// The unit of z is the largest shift on a level mat or, on a slope, one that balances gravity if
// that is larger. advance() counts evaluations, of which a step takes one at least.
MemoryRoll::MemoryRoll(const Body& body, Geometry geometry, PowerLaw law, Bulge bulge, double v0,
                       double x0, Stepper stepper, double rtol, unsigned long most_steps)
    : SolvedRoll(
          body, geometry, equations(body, geometry, law, bulge, v0),
          {stepper,
           rtol,
           1e-3 * rtol,
           0,
           40 * most_steps,
           {bulge.length, v0, std::max({law(v0), body.R * std::abs(body.slope), least_speed})}},
          {x0, v0, law(v0)}),
      law_(law), bulge_(bulge), most_evaluations_(40 * most_steps), at_rest_(v0 == 0) {}

double MemoryRoll::fastest(const std::vector<double>& y) const {
  const double z = y[2], c = body_.g / ((body_.K + arm_factor(body_, geometry_, z)) * body_.R),
               power = 2 + law_.b;
  return std::pow(
      std::pow(std::abs(y[1]), power) + power * bulge_.length * c * z * z / (2 * law_.a),
      1 / power);
}

bool MemoryRoll::advance(Integrator& ode, double& crept, double t) const {
  const unsigned long before = ode.evaluations();
  const bool rests = law_.b < 2 && body_.slope == 0;
  // The right-hand side has a kink at v = 0; therefore each zero is located, and the integration
  // restarts from v = 0 exactly. The bulge pushes the body away from there, against z.
  for (;;) {
    const double v = ode.state()[1], way = v > 0 || (v == 0 && ode.state()[2] < 0) ? 1 : -1;
    if (!ode.advance(t,
                     [&](const std::vector<double>& y) {
      if (ode.evaluations() - before > most_evaluations_)
        fail(
            "the roll with memory takes more than {} evaluations, at t = {:.6g} s: msbdf, if the "
            "problem is stiff, an earlier end, another length or a damping",
            most_evaluations_, ode.time());
      return std::min(way * y[1], crept > 0 ? fastest(y) - crept : infinity);
        }))
      return false;
    std::vector<double> y = ode.state();
    if (crept > 0 && fastest(y) - crept <= way * y[1]) return true;
    y[1] = 0;
    ode.restart(ode.time(), y);
    if (rests && crept > 0 && fastest(y) <= rest_fraction * v0()) return true;
    if (rests && crept == 0) crept = rest_fraction * fastest(y);
  }
}

double MemoryRoll::stop_time() {
  if (v0() == 0) return 0;
  if (law_.b >= 2 || body_.slope != 0) return infinity;
  if (!stop_time_) {
    Integrator ode = from_start();
    double crept = 0;
    advance(ode, crept, infinity);
    stop_time_ = ode.time();
  }
  return *stop_time_;
}

void MemoryRoll::seek(double t) {
  if (at_rest_) return;
  // The computed time of rest depends, within rounding, on the steps. The first value that was
  // returned remains valid.
  const double stop = stop_time_.value_or(infinity);
  at_rest_ = advance(ode_, crept_, std::min(t, stop)) || t >= stop;
  if (at_rest_ && !stop_time_) stop_time_ = ode_.time();
}

double MemoryRoll::shift() {
  const double z = ode_.state()[2];
  return at_rest_ ? 0 : z + bulge_.damping * std::abs(v()) * (law_(v()) - z) / bulge_.length;
}

}  // namespace rolling
