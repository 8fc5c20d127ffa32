// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/roll.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "contact/contact.h"

namespace rolling {
namespace {

constexpr double first_part = 1e-18;  // of v0: the way back begins there

const Body& checked(const Body& body, const Law& law, double v0) {
  const auto check = [](const char* name, double value, bool positive) {
    if (!(value >= 0 && std::isfinite(value)) || (positive && value == 0))
      fail("{} = {} must be a {}", name, value,
           positive ? "positive number" : "number that is not negative");
  };
  check("the radius R", body.R, true);
  check("the shape factor K", body.K, false);
  check("gravity g", body.g, true);
  check("the initial velocity v0", v0, false);
  if (!std::isfinite(body.slope)) fail("the slope {} must be finite", body.slope);
  if (!std::isfinite(body.wind)) fail("the wind {} must be finite", body.wind);
  law.check_speed(v0);
  return body;
}

}  // namespace

void check_roll(const Body& body, const Law& law, double v0) {
  checked(body, law, v0);
  const auto power = law.power();
  if (!power) {
    const Law blown = law.in_wind(body.wind);
    double largest = std::abs(blown.at(v0).D);
    if (blown.wind() != 0) largest = std::max(largest, std::abs(blown.at_rest()));
    for (const double v : blown.corners())
      if (v < v0) largest = std::max(largest, blown.at(v).D);
    return check_shift(body, largest);
  }
  if (!(power->a > 0 && std::isfinite(power->a)))
    fail("the coefficient a = {} must be a positive number", power->a);
  if (!(std::abs(power->b) <= 1000)) fail("the exponent b = {} is beyond -1000 to 1000", power->b);
  const double D = (*power)(v0);
  if (!std::isfinite(D)) fail("the shift at v0 = {} m/s has no finite value", v0);
  check_shift(body, D);
}

Roll::Roll(const Body& body, const Law& law, double v0, double x0, double tolerance)
    : body_(checked(body, law, body.road ? std::abs(v0) : v0)), law_(law.in_wind(body.wind)),
      v0_(body.road ? 0 : v0), ahead_(body, law, v0_), way_on_(v0 == 0 && holds(-1) ? 1 : -1),
      turns_((v0 == 0 || ahead_.slows()) && !holds(way_on_)) {
  if (body.road) road_ = std::make_shared<RoadRoll>(body, law, v0, x0, tolerance);
}

/// True if the mat holds the body at rest, or at a speed that counts as rest, so that it does not
/// begin to roll in this direction.
bool Roll::holds(double way) const {
  const Body body = seen_along(body_, way);
  const Law law = law_.in_wind(body.wind);
  const auto balances = [&](double D) { return accelerate(body, D).a <= 0; };
  return balances(law.at_rest()) || balances(law.at(Leg::negligible * v0_).D);
}

/// The way on from rest, or from a speed that is not seen.
Leg& Roll::back() {
  if (!back_) {
    const double first = first_part * (v0_ > 0 ? v0_ : std::sqrt(body_.g * body_.R));
    back_.emplace(seen_along(body_, way_on_), law_, first);
  }
  return *back_;
}

// With T and X the time and the place of the turning point, on the way back v = -u(t - T) and
// x = X - way(t - T).
Roll::Point Roll::at(double t) {
  if (road_) return road_->at(t);
  if (!turns_ || stop_until(t) > t) return ahead_.at(t);
  const double since = t - stop_time();
  const double sign = way_on_;
  const Point turn = ahead_.at(stop_time());
  const Derivatives T_c = stop_time_by_c();
  const double T_v0 = ahead_.stop_time_by_v0();
  const Point q = back().at(since);
  Point p{.v = since > 0 ? sign * q.v : 0, .x = turn.x + sign * q.x, .a = sign * q.a};
  p.v_v0 = -sign * q.a * T_v0;
  p.x_v0 = turn.x_v0 - sign * q.v * T_v0;
  for (std::size_t j = 0; j < most; ++j) {
    const double by = j < law_.size() ? 1 : sign;  // slope and wind as it sees them
    p.v_c[j] = sign * (by * q.v_c[j] - q.a * T_c[j]);
    p.x_c[j] = turn.x_c[j] + sign * (by * q.x_c[j] - q.v * T_c[j]);
  }
  return p;
}

}  // namespace rolling
