// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/integrated_roll.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/error.h"
#include "contact/contact.h"

namespace rolling {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
constexpr double unseen = 1e-16;     // of the time: what follows does not show in a double
constexpr double last_part = 1e-10;  // of the time; in a smaller one, rounding of t exceeds a step

/// The speed at which the solver ends: what is left of the time is like v^(1-b). 0 if the body
/// never stops.
double floor_of(const Law& law, std::optional<double> rest, double v0) {
  const auto power = law.power();
  const double b = power ? std::min(power->b, 0.0) : 0;
  return rest ? std::max(std::pow(last_part, 1 / (1 - b)) * v0, *rest) : 0;
}

OdeSystem equations(const Body& body, Geometry geometry, const Law& law, double floor) {
  // Below the floor D is constant, so that v crosses the floor: nothing attracts the solver to v =
  // 0.
  const auto shift = [law, floor](double v) {
    return floor > 0 || v > 0 ? law(std::max(v, floor)) : 0;
  };
  const auto derivative = [body, geometry, shift](double, const double* y, double* dydt) {
    dydt[0] = y[1];
    dydt[1] = trial_acceleration(body, geometry, shift(y[1]));
  };
  const auto jacobian =
      [body, geometry, shift, law, floor](double, const double* y, double* dfdy, double* dfdt) {
    dfdy[0] = 0, dfdy[1] = 1, dfdy[2] = 0;
    dfdy[3] = y[1] <= floor ? 0
                            : trial_acceleration_slope(body, geometry, shift(y[1])) *
                                  law.at(y[1]).by_log_v / y[1];
    dfdt[0] = dfdt[1] = 0;
  };
  const auto longest = [body, geometry, shift, floor](const double* y) {
    const double v = std::max(y[1], floor);
    return v > 0 ? v / (2 * std::abs(trial_acceleration(body, geometry, shift(v)))) : infinity;
  };
  return {derivative, jacobian, longest};
}

}  // namespace

IntegratedRoll::IntegratedRoll(const Body& body, Geometry geometry, Law law,
                               std::optional<double> rest, double v0, double x0, Stepper stepper,
                               double rtol, unsigned long most_steps)
    : SolvedRoll(body, geometry, equations(body, geometry, law, floor_of(law, rest, v0)),
                 {stepper, rounding, v0 > 0 ? rtol * last_part * v0 : 1, rtol, most_steps},
                 {x0, v0}),
      law_(std::move(law)), rest_(rest), floor_(floor_of(law_, rest, v0)) {
  if (v0 == 0) tail_ = {0, 0, 0, 0};
}

Integrator::Event IntegratedRoll::floor_event() const {
  const bool exact = geometry_ == Geometry::exact;
  return [floor = floor_, exact, R = body_.R, v0 = v0(), law = law_](const std::vector<double>& y) {
    // The way to D = R is a speed too: of two units one would not be seen beside the other.
    const double left = y[1] - floor;
    return exact && y[1] > 0 ? std::min(left, (1 - law(y[1]) / R) * v0) : left;
  };
}

IntegratedRoll::Tail IntegratedRoll::tail(const Integrator& ode) const {
  const double t = ode.time(), v = std::max(0.0, ode.state()[1]), D = law_(v), R = body_.R;
  // The event is that of the closer limit: the rounding of t moves it away from the state a little,
  // so that v may be above or below the floor.
  bool grows_to_R = geometry_ == Geometry::exact && (R - D) * floor_ < std::abs(v - floor_) * R;
  Tail tail{t, 0, v, 0};
  if (!grows_to_R && rest_ != floor_) {
    const double a = trial_acceleration(body_, geometry_, D), power = law_.at(v).by_log_v / D;
    tail.q = D * trial_acceleration_slope(body_, geometry_, D) * power / a;
    tail.duration = v / ((1 - tail.q) * -a);
    grows_to_R = geometry_ == Geometry::exact && power < 0 &&
                 v * std::pow(D / R, -1 / power) * body_.K / body_.g > unseen * t;
  }
  if (grows_to_R) fail("at t = {:.6g} s the shift has grown to the radius {:.6g} m", t, R);
  return tail;
}

double IntegratedRoll::stop_time() {
  if (v0() > 0 && !rest_) return infinity;
  if (!tail_) {
    Integrator ode = from_start();
    ode.advance(infinity, floor_event());
    tail_ = tail(ode);
  }
  return tail_->begin + tail_->duration;
}

void IntegratedRoll::seek(double t) {
  t_ = t;
  // The computed time of the stop depends, within the error of the solver, on the steps. The first
  // value that was returned remains valid.
  if (v() > floor_ && ode_.advance(tail_ ? std::min(t, tail_->begin) : t, floor_event()) && !tail_)
    tail_ = tail(ode_);
  if (v() > law_.highest() * (1 + 1e-9))
    fail("at t = {:.6g} s the speed {:.6g} m/s is above the table of the law, which ends at {}",
         ode_.time(), v(), law_.highest());
}

double IntegratedRoll::left() const {
  return std::max(0.0, 1 - (t_ - tail_->begin) / tail_->duration);
}

double IntegratedRoll::velocity() {
  if (!tail_ || t_ < tail_->begin) return std::max(0.0, v());
  return t_ < stop_time() ? tail_->v * std::pow(left(), 1 / (1 - tail_->q)) : 0;
}

double IntegratedRoll::position() {
  if (!tail_ || t_ <= tail_->begin) return x();
  const double q = tail_->q;
  return x() +
         tail_->v * tail_->duration * (1 - q) / (2 - q) * (1 - std::pow(left(), (2 - q) / (1 - q)));
}

double IntegratedRoll::shift() {
  const double v = velocity(), D = law_(v);
  check_shift(body_, D);
  return D;
}

}  // namespace rolling
