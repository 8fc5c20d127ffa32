// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/solved_roll.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/error.h"
#include "contact/contact.h"
#include "motion/roll.h"

namespace rolling {

namespace {

constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
constexpr double last_part =
    1e-10;  // of v0 and of the time; in a smaller one, rounding of t exceeds a step

double unit_of_speed(const Scene& s) { return s.v0 > 0 ? s.v0 : std::sqrt(s.body.g * s.body.R); }

OdeSystem equations_of_law(const Body& body, Geometry geometry, const Law& law, double floor) {
  // Below the floor D is constant, so that v crosses it: nothing attracts the solver to v = 0.
  const auto shift = [law, floor](double v) {
    return law(std::copysign(std::max(std::abs(v), floor), v));
  };
  const auto derivative = [body, geometry, shift](const double* y, double* dydt) {
    dydt[0] = y[1];
    dydt[1] = trial_acceleration(body, geometry, shift(y[1]));
  };
  const auto jacobian = [body, geometry, shift, law, floor](const double* y, double* dfdy) {
    const double v = std::abs(y[1]);
    dfdy[0] = 0, dfdy[1] = 1, dfdy[2] = 0;
    dfdy[3] = v <= floor
                  ? 0
                  : trial_acceleration_slope(body, geometry, shift(y[1])) * law.at(v).by_log_v / v;
  };
  const auto longest = [body, geometry, shift, floor](const double* y) {
    const double v = std::max(std::abs(y[1]), floor);
    return v > 0 ? v / (2 * std::abs(trial_acceleration(body, geometry, shift(y[1])))) : INFINITY;
  };
  return {derivative, jacobian, longest};
}

}  // namespace

IntegratedRoll::End IntegratedRoll::end_of(const Scene& s) {
  Roll roll(s.body, s.geometry, s.law, s.v0);
  if (!std::isfinite(roll.stop_time())) return {0, false, roll.turns(), roll.way_on()};
  const auto power = s.law.power();
  const double b = power ? std::min(power->b, 0.0) : 0, rest = roll.rest_speed(),
               floor = std::pow(last_part, 1 / (1 - b)) * unit_of_speed(s);
  return {std::max(floor, rest), rest > floor, roll.turns(), roll.way_on()};
}

// From v0 = 0 the way back begins at once. The sign of a v that is 0 tells its direction.
IntegratedRoll::IntegratedRoll(const Scene& s, Stepper stepper, double rtol,
                               unsigned long most_steps)
    : SolvedRoll(
          s, most_steps,
          [=, end = end_of(s)] {
  return Integrator(equations_of_law(s.body, s.geometry, s.law.in_wind(s.body.wind), end.floor),
                    stepper,
                    {rounding, rtol * last_part, rtol, {unit_of_speed(s), unit_of_speed(s)}},
                    {s.x0, s.v0 > 0 ? s.v0 : std::copysign(0, end.way_on)});
          }),
law_(s.law.in_wind(s.body.wind)), end_(end_of(s)) {
  turns_ = end_.turns, at_rest_ = s.v0 == 0 && !turns_;
  if (s.v0 == 0) stop_time_ = 0;
  else if (end_.floor == 0) stop_time_ = INFINITY;
}

bool IntegratedRoll::advance(Course& course, double t, unsigned long steps) {
  Integrator& ode = course.ode;
  const bool stops = ode.advance(
      t,
      [&](const std::vector<double>& y) {
    const double v = y[1];
    if (geometry_ == Geometry::exact && std::abs(law_(v)) >= body_.R)
      fail("at t = {:.6g} s the shift has grown to the radius {:.6g} m", ode.time(), body_.R);
    law_.check_speed(v);
    return v0_ > 0 ? v - end_.floor : 1;
      },
      steps);
  if (!stops) return false;
  const double v = ode.state()[1], D = law_(v), a = trial_acceleration(body_, geometry_, D),
               q = law_.at(v).by_log_v * trial_acceleration_slope(body_, geometry_, D) / a;
  ode.restart(ode.time() + (end_.creeps ? 0 : v / ((1 - q) * -a)),
              {ode.state()[0], std::copysign(0, end_.way_on)});
  return true;
}

double IntegratedRoll::shift() {
  const double D = law_(velocity());
  check_shift(body_, D);
  return D;
}

namespace {

constexpr double rest_fraction = 1e-3;  // of v0
// Measured: above `stiff` an implicit solver is faster, above `very_stiff` it takes more than .1 s,
// and the extrapolation of bsimp .02 s, for an error of 1e-9.
constexpr double stiff = 3e4, very_stiff = 2e7;

// y = (x, v, z).
OdeSystem equations(const Scene& scene, PowerLaw law) {
  const Body body = scene.body;
  const Geometry geometry = scene.geometry;
  const Bulge bulge = scene.bulge;
  const auto derivative = [=](const double* y, double* dydt) {
    const double v = y[1], z = y[2];
    dydt[0] = v;
    dydt[2] = std::abs(v) * (law(v) - z) / bulge.length;
    dydt[1] = trial_acceleration(body, geometry, z + bulge.damping * dydt[2]);
  };
  const auto jacobian = [=](const double* y, double* dfdy) {
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
  };
  // Where the error of a step vanishes, as under a constant shift, nothing else limits it.
  const auto longest = [derivative, v0 = scene.v0](const double* y) {
    double dydt[3];
    derivative(y, dydt);
    return (v0 + std::abs(y[1])) / std::abs(dydt[1]);
  };
  return {derivative, jacobian, longest};
}

PowerLaw law_of(const Scene& scene) {
  const auto law = scene.law.power();
  if (!law || law->b < 0)
    fail("the memory goes with a law a v^b alone, whose shift is finite at rest: b is not below 0");
  return *law;
}

}  // namespace

Stepper memory_stepper(const Scene& scene) {
  // With z near the law, the shift z + damping z' of a body that slows down is smaller than z, by
  // the factor 1 + damping c dD/dv.
  const auto [D, by_log_v] = scene.law.at(scene.v0);
  const double damping = scene.bulge.damping,
               q = std::abs(trial_acceleration(scene.body, Geometry::approximate, D)),
               slowing = scene.v0 / q + damping * by_log_v / D,
               following = scene.bulge.length / (scene.v0 + damping * q);
  if (slowing > very_stiff * following) return Stepper::bsimp;
  return slowing > stiff * following ? Stepper::rk4imp : Stepper::rk8pd;
}

// The unit of z is the largest shift on a level mat or, on a slope, one that balances gravity if
// that is larger; it is above 0.
MemoryRoll::MemoryRoll(const Scene& s, Stepper stepper, double rtol, unsigned long most_steps)
    : SolvedRoll(
          s, most_steps,
          [=, law = law_of(s), D0 = s.law(s.v0)] {
  return Integrator(
      equations(s, law), stepper,
      {rtol,
       1e-3 * rtol,
       0,
       {s.bulge.length, s.v0, std::max({D0, s.body.R * std::abs(s.body.slope), least_speed})}},
      {s.x0, s.v0, D0});
          }),
law_(law_of(s)), bulge_(s.bulge) {
  at_rest_ = v0_ == 0;
  if (at_rest_) stop_time_ = 0;
  else if (law_.b >= 2 || body_.slope != 0) stop_time_ = INFINITY;
}

double MemoryRoll::fastest(const std::vector<double>& y) const {
  const double z = y[2], c = body_.g / ((body_.K + arm_factor(body_, geometry_, z)) * body_.R),
               power = 2 + law_.b;
  return std::pow(
      std::pow(std::abs(y[1]), power) + power * bulge_.length * c * z * z / (2 * law_.a),
      1 / power);
}

bool MemoryRoll::advance(Course& course, double t, unsigned long steps) {
  auto& [ode, creep] = course;  // creep: the bound of |v| at which it is rest, after the first zero
  // The right-hand side has a kink at v = 0; therefore each zero is located, and the integration
  // restarts from v = 0 exactly. The bulge pushes the body away from there, against z.
  for (;;) {
    const double v = ode.state()[1], way = v > 0 || (v == 0 && ode.state()[2] < 0) ? 1 : -1;
    if (!ode.advance(
            t,
            [&, creep = creep](const std::vector<double>& y) {
      return std::min(way * y[1], creep > 0 ? fastest(y) - creep : INFINITY);
            },
            steps))
      return false;
    std::vector<double> y = ode.state();
    const double bound = fastest(y);
    if (creep > 0 && bound - creep <= way * y[1]) return true;
    y[1] = 0;
    ode.restart(ode.time(), y);
    if (stop_time_ == INFINITY) continue;
    if (creep == 0) creep = rest_fraction * bound;
    else if (bound <= rest_fraction * v0_) return true;
  }
}

double MemoryRoll::shift() {
  const double v = velocity(), z = course_.ode.state()[2];
  return at_rest_ ? 0 : z + bulge_.damping * std::abs(v) * (law_(v) - z) / bulge_.length;
}

}  // namespace rolling
