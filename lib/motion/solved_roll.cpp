// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/solved_roll.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/error.h"
#include "contact/contact.h"
#include "motion/roll.h"

namespace rolling {

SolvedRoll::SolvedRoll(const Scene& scene, Stepper stepper, unsigned long most_steps)
    : body_(scene.body), incline_(incline(body_)), v0_(scene.v0), stepper_(stepper),
      most_steps_(most_steps) {
  if (v0_ > 0 && v0_ < least_speed)
    fail("the initial velocity v0 = {} is too small for a solver: the least is {:g} m/s", v0_,
         least_speed);
}

void SolvedRoll::begin(Tolerance tolerance, std::vector<double> y) {
  tolerance_ = std::move(tolerance);
  first_ = std::move(y);
  course_.emplace(from_start());
}

double SolvedRoll::stop_time() {
  if (!stop_time_) {
    Course course = from_start();
    advance(course, INFINITY, most_steps_);
    stop_time_ = course.ode.time();
  }
  return *stop_time_;
}

void SolvedRoll::seek(double t) {
  if (at_rest_) return;
  // The first value that stop_time() has returned remains valid: within the error of the solver it
  // depends on the steps.
  const double end = turns_ ? INFINITY : stop_time_.value_or(INFINITY);
  const bool stops = advance(*course_, std::min(t, end), most_steps_);
  at_rest_ = !turns_ && (stops || t >= end);
  if (!stops) return;
  if (!stop_time_) stop_time_ = course_->ode.time();
  if (turns_) advance(*course_, t, most_steps_);
}

double SolvedRoll::acceleration() {
  const double D = shift();
  return at_rest_ ? 0 : acceleration_from_shift(body_, D);
}

namespace {

constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
// Of v0 and of the time: in a smaller part, the rounding of t exceeds a step.
constexpr double last_part = 1e-10;

}  // namespace

// From v0 = 0 the way back begins at once. The sign of a v that is 0 tells its direction.
IntegratedRoll::IntegratedRoll(const Scene& s, Stepper stepper, double rtol,
                               unsigned long most_steps)
    : SolvedRoll(s, stepper, most_steps), law_(s.law.in_wind(s.body.wind)) {
  Roll roll(s.body, s.law, s.v0);
  const double unit = v0_ > 0 ? v0_ : std::sqrt(body_.g * body_.R);
  if (std::isfinite(roll.stop_time())) {
    const auto power = law_.power();
    floor_ = std::pow(last_part, 1 / (1 - std::min(power ? power->b : 0, 0.0))) * unit;
    creeps_ = roll.rest_speed() > floor_;
    if (creeps_) floor_ = roll.rest_speed();
  }
  turns_ = roll.turns();
  way_on_ = roll.way_on();
  at_rest_ = v0_ == 0 && !turns_;
  if (v0_ == 0) stop_time_ = 0;
  else if (floor_ == 0) stop_time_ = INFINITY;
  begin({rounding, rtol * last_part, rtol, {unit, unit}},
        {s.x0, v0_ > 0 ? v0_ : std::copysign(0, way_on_)});
}

/// Below the floor D is constant, so that v crosses it: nothing attracts the solver to v = 0.
double IntegratedRoll::floored(double v) const {
  return law_(std::copysign(std::max(std::abs(v), floor_), v));
}

void IntegratedRoll::derivative(const double* y, double* dydt) const {
  dydt[0] = y[1];
  dydt[1] = accelerate(body_, floored(y[1]), incline_).a;
}

void IntegratedRoll::jacobian(const double* y, double* dfdy) const {
  const double v = std::abs(y[1]);
  dfdy[0] = dfdy[2] = dfdy[3] = 0;
  dfdy[1] = 1;
  if (v > floor_)
    dfdy[3] = accelerate(body_, floored(y[1]), incline_).by_D * law_.at(v).by_log_v / v;
}

double IntegratedRoll::longest_step(const double* y) const {
  const double v = std::max(std::abs(y[1]), floor_);
  if (v == 0) return INFINITY;
  return v / (2 * std::abs(accelerate(body_, floored(y[1]), incline_).a));
}

bool IntegratedRoll::advance(Course& course, double t, unsigned long steps) {
  Integrator& ode = course.ode;
  const bool stops = ode.advance(t, steps, [&](const std::vector<double>& y) {
    if (body_.exact && std::abs(law_(y[1])) >= body_.R)
      fail("at t = {:.6g} s the shift has grown to the radius {:.6g} m", ode.time(), body_.R);
    law_.check_speed(y[1]);
    return v0_ > 0 ? y[1] - floor_ : 1;
  });
  if (!stops) return false;
  const double v = ode.state()[1];
  const Acceleration now = accelerate(body_, law_(v), incline_);
  const double exponent = law_.at(v).by_log_v * now.by_D / now.a;
  const double left = creeps_ ? 0 : v / ((1 - exponent) * -now.a);
  ode.restart(ode.time() + left, {ode.state()[0], std::copysign(0, way_on_)});
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
  const double damping = scene.bulge.damping;
  Body body = scene.body;
  body.exact = false;  // A = 1 is near enough
  const double q = std::abs(accelerate(body, D).a);
  const double slowing = scene.v0 / q + damping * by_log_v / D;
  const double following = scene.bulge.length / (scene.v0 + damping * q);
  if (slowing > very_stiff * following) return gsl_odeiv2_step_bsimp;
  return slowing > stiff * following ? gsl_odeiv2_step_rk4imp : gsl_odeiv2_step_rk8pd;
}

// The unit of z is the largest shift on a level mat or, on a slope, one that balances gravity if
// that is larger; it is above 0.
MemoryRoll::MemoryRoll(const Scene& s, Stepper stepper, double rtol, unsigned long most_steps)
    : SolvedRoll(s, stepper, most_steps), law_(law_of(s)), bulge_(s.bulge) {
  at_rest_ = v0_ == 0;
  if (at_rest_) stop_time_ = 0;
  else if (law_.b >= 2 || body_.slope != 0) stop_time_ = INFINITY;
  const double D = law_(v0_);
  const double unit = std::max({D, body_.R * std::abs(body_.slope), least_speed});
  begin({rtol, 1e-3 * rtol, 0, {bulge_.length, v0_, unit}}, {s.x0, v0_, D});
}

void MemoryRoll::derivative(const double* y, double* dydt) const {
  const double v = y[1];
  const double z = y[2];
  dydt[0] = v;
  dydt[2] = std::abs(v) * (law_(v) - z) / bulge_.length;
  dydt[1] = accelerate(body_, z + bulge_.damping * dydt[2], incline_).a;
}

void MemoryRoll::jacobian(const double* y, double* dfdy) const {
  const double v = y[1];
  const double z = y[2];
  const double speed = std::abs(v);
  const double dz = speed * (law_(v) - z) / bulge_.length;
  const double dv_dD = accelerate(body_, z + bulge_.damping * dz, incline_).by_D;
  const double dz_dv =
      ((1 + law_.b) * std::abs(law_(v)) - std::copysign(1.0, v) * z) / bulge_.length;
  const double dz_dz = -speed / bulge_.length;
  const double by_v = dv_dD * bulge_.damping * dz_dv;
  const double by_z = dv_dD * (1 + bulge_.damping * dz_dz);
  const double rows[9] = {0, 1, 0, 0, by_v, by_z, 0, dz_dv, dz_dz};
  std::copy(rows, rows + 9, dfdy);
}

/// Where the error of a step vanishes, as under a constant shift, nothing else limits it.
double MemoryRoll::longest_step(const double* y) const {
  double dydt[3];
  derivative(y, dydt);
  return (v0_ + std::abs(y[1])) / std::abs(dydt[1]);
}

double MemoryRoll::fastest(const std::vector<double>& y) const {
  const double z = y[2];
  const double c = body_.g / ((body_.K + arm_factor(body_, z)) * body_.R);
  const double power = 2 + law_.b;
  const double of_bulge = power * bulge_.length * c * z * z / (2 * law_.a);
  return std::pow(std::pow(std::abs(y[1]), power) + of_bulge, 1 / power);
}

bool MemoryRoll::advance(Course& course, double t, unsigned long steps) {
  auto& [ode, creep] = course;  // creep: the bound of |v| at which it is rest, after the first zero
  // The right-hand side has a kink at v = 0; therefore each zero is located, and the integration
  // restarts from v = 0 exactly. The bulge pushes the body away from there, against z.
  for (;;) {
    const double v = ode.state()[1];
    const double way = v > 0 || (v == 0 && ode.state()[2] < 0) ? 1 : -1;
    const auto event = [&, creep = creep](const std::vector<double>& y) {
      return std::min(way * y[1], creep > 0 ? fastest(y) - creep : INFINITY);
    };
    if (!ode.advance(t, steps, event)) return false;
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
  const double v = velocity();
  const double z = course_->ode.state()[2];
  return at_rest_ ? 0 : z + bulge_.damping * std::abs(v) * (law_(v) - z) / bulge_.length;
}

}  // namespace rolling
