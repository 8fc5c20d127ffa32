// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/integrated_roll.h"

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

OdeSystem equations(const Body& body, Geometry geometry, const Law& law, double floor) {
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
  if (!std::isfinite(roll.stop_time())) return {0, false, false};
  const auto power = s.law.power();
  const double b = power ? std::min(power->b, 0.0) : 0, rest = roll.rest_speed(),
               floor = std::pow(last_part, 1 / (1 - b)) * unit_of_speed(s);
  return {std::max(floor, rest), rest > floor, roll.turns()};
}

// From v0 = 0 the way back begins at once. The sign of a v that is 0 tells its direction.
IntegratedRoll::IntegratedRoll(const Scene& s, Stepper stepper, double rtol,
                               unsigned long most_steps)
    : SolvedRoll(
          s, most_steps,
          [=, floor = end_of(s).floor] {
  return Integrator(equations(s.body, s.geometry, s.law, floor), stepper,
                    {rounding, rtol * last_part, rtol, {unit_of_speed(s), unit_of_speed(s)}},
                    {s.x0, s.v0 > 0 ? s.v0 : -std::copysign(0, s.body.slope)});
          }),
law_(s.law), end_(end_of(s)) {
  turns_ = end_.turns, at_rest_ = s.v0 == 0 && !turns_;
  if (s.v0 == 0) stop_time_ = 0;
  else if (end_.floor == 0) stop_time_ = infinity;
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
              {ode.state()[0], -std::copysign(0, body_.slope)});
  return true;
}

double IntegratedRoll::shift() {
  const double D = law_(velocity());
  check_shift(body_, D);
  return D;
}

}  // namespace rolling
