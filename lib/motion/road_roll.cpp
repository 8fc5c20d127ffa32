// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/road_roll.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "contact/contact.h"
#include "contact/road.h"

namespace rolling {
namespace {

constexpr double at_rest = 1e-10;       // of the highest speed
constexpr double least_speed = 1e-200;  // where the derivative of a v^b by b has a number
constexpr double alike = 0.2;           // part of dv/dt by which it changes over the way to a turn
constexpr std::size_t most_segments = 1'000'000;

// Elements of a state.
enum { of_t, of_x, of_clock, first };

}  // namespace

RoadRoll::RoadRoll(const Body& body, const Law& law, double v0, double x0, double tolerance)
    : body_(body), with_(law.in_wind(body.wind)), against_(law.in_wind(-body.wind)), x0_(x0),
      highest_(std::abs(v0)), count_(law.size() + 3) {
  body.road->check(x0);
  end_.resize(first + 2 * (2 + count_));
  end_[of_x] = x0;
  heading_ = v0 < 0 ? -1 : 1;
  in_place_ = v0 != 0;
  const double a = rate(highest_, x0, heading_).a;
  if (!std::isfinite(a)) fail("the deceleration at v0 = {} m/s has no finite value", v0);
  // By v0: at a fixed x the speed changes; from rest see from_rest(). By x0: at a fixed x the time
  // and the speed, at rest the place.
  if (in_place_) {
    end_[of_clock] = v0 * v0 / 2;
    end_[first + 1] = v0;
    end_[first + 2] = -1 / v0;
    end_[first + 3] = -a * heading_;
  } else {
    end_[first + 3] = 1;
    heading_ = -1;
  }
  const std::vector<double> units(end_.size(), 1);
  ode_ = Integrator(*this, gsl_odeiv2_step_rk8pd, {0.1 * tolerance, 1e-30, tolerance, units}, end_);
}

void RoadRoll::leaves(const char* what) const {
  fail("the body leaves {} at t = {:.6g} s, x = {:.6g} m", what, end_[of_t],
       body_.road->way() * end_[of_x]);
}

double RoadRoll::Segment::speed(double clock) const {
  return of_place() ? std::sqrt(2 * clock) : clock * clock * clock * clock;
}

/// The formula of the class, with trial values of u and x.
RoadRoll::Rate RoadRoll::rate(double u, double x, double way) const {
  Rate r{};
  const Law& law = way > 0 ? with_ : against_;
  const Road::Place place = body_.road->at(x);
  const double f = body_.steepness;
  const double sin = f * place.h1 + body_.slope;
  const double cos2 = 1 - sin * sin;
  const double cos = std::sqrt(cos2);
  const double curve = u * u / body_.g / cos;  // times h'' it adds to the cosine
  const double across = cos + curve * f * place.h2;
  const auto [D, D_by_log_u] = law.at(u, r.a_p.data());
  const Acceleration now = accelerate(body_, D, {across, way * sin / across});
  r.N = across * body_.g;
  r.a = now.a;
  r.a_u = u > 0 ? (now.by_D * D_by_log_u + 2 * now.by_cos * curve * f * place.h2) / u : 0;
  const double by_bend = now.by_cos * curve;
  const double by_sin = way * now.by_sin + (by_bend * f * place.h2 / cos2 - now.by_cos / cos) * sin;
  r.a_x = by_sin * f * place.h2 + by_bend * f * place.h3;
  const std::size_t n = law.size();
  for (std::size_t j = 0; j < n; ++j) r.a_p[j] *= now.by_D;
  r.a_p[n] = by_sin;
  r.a_p[n + 1] = way * now.by_D * law.by_wind(u);
  r.a_p[n + 2] = by_sin * place.h1 + by_bend * place.h2;
  return r;
}

/// True if the track holds the body at rest, so that it does not begin to roll in this direction.
bool RoadRoll::holds(double x, double way) const {
  return rate(0, x, way).a <= 0 || rate(Leg::negligible * highest_, x, way).a <= 0;
}

/// The next point of the table; at its end x itself.
double RoadRoll::next_point(double x, double way) const {
  const std::vector<double>& points = body_.road->points();
  if (way > 0) {
    const auto next = std::ranges::upper_bound(points, x);
    return next == points.end() ? x : *next;
  }
  const auto next = std::ranges::lower_bound(points, x);
  return next == points.begin() ? x : *(next - 1);
}

/// How fast dv/dt changes at most with x up to the next point: h'' is linear there.
double RoadRoll::bend(double u, double x, double way) const {
  return std::max(std::abs(rate(u, x, way).a_x), std::abs(rate(u, next_point(x, way), way).a_x));
}

void RoadRoll::derivative(const double* y, double* dy) const {
  const bool of_place = change_ == 0;
  const double w = y[of_clock];
  const double u = of_place ? std::sqrt(2 * w) : std::max(w * w * w * w, least_speed);
  const Rate r = rate(u, y[of_x], way_);
  const double dt = pace_ * (of_place ? 1 / u : change_ * 4 * w * w * w / r.a);
  dy[of_t] = dt;
  dy[of_x] = way_ * (of_place ? pace_ : u * dt);
  dy[of_clock] = pace_ * (of_place ? r.a : change_);
  for (std::size_t p = 0; p < 2 + count_; ++p) {
    const double* const by = y + first + 2 * p;
    double* const d = dy + first + 2 * p;
    const double a_p = p < 2 ? 0 : r.a_p[p - 2];
    if (of_place) {
      d[0] = -pace_ * by[1] / (u * u * u);
      d[1] = pace_ * (r.a_u / u * by[1] + a_p);
    } else {
      d[0] = -dt * (r.a_x * by[1] + a_p) / r.a;
      d[1] = way_ * u * d[0];
    }
  }
}

/// The state after this much of the clock of a segment, back to the beginning if it is below 0.
RoadRoll::State RoadRoll::along(const Segment& segment, const State& from, double length) {
  if (length == 0) return from;
  way_ = segment.way;
  change_ = segment.change;
  pace_ = length > 0 ? 1 : -1;
  ode_->restart(0, from);
  unsigned long steps = 10'000;
  try {
    ode_->advance(std::abs(length), steps);
  } catch (const Error&) {  // its time is the clock
    fail("the motion cannot be followed beyond t = {:.6g} s, x = {:.6g} m", from[of_t],
         body_.road->way() * from[of_x]);
  }
  return ode_->state();
}

/// Converts a state from the clock x to the clock u, and back.
void RoadRoll::to_speed(State& y, double way) const {
  const double u = std::sqrt(2 * y[of_clock]);
  const double a = rate(u, y[of_x], way).a;
  for (std::size_t i = first; i < y.size(); i += 2) {
    const double dt = -y[i + 1] / u / a;
    y[i] += dt;
    y[i + 1] = way * u * dt;
  }
  y[of_clock] = std::sqrt(std::sqrt(u));
}

void RoadRoll::to_place(State& y, double way) const {
  const double u = std::pow(y[of_clock], 4);
  const double a = rate(u, y[of_x], way).a;
  for (std::size_t i = first; i < y.size(); i += 2) {
    const double dx = y[i + 1];
    y[i] -= way * dx / u;
    y[i + 1] = -a * way * dx;
  }
  y[of_clock] = u * u / 2;
}

/// From a turning point, or from the beginning at rest: until the speed has changed dv/dt to a
/// half, or the way is that to the next point or changes dv/dt by much.
RoadRoll::Segment RoadRoll::from_rest() const {
  const double x = end_[of_x];
  for (const double way : {-heading_, heading_}) {
    if (holds(x, way)) continue;
    const Rate r = rate(least_speed, x, way);
    const double room = std::abs(next_point(x, way) - x);
    const double length = std::min(room, alike * r.a / bend(least_speed, x, way));
    double u = std::sqrt(length * r.a);
    while (!(rate(u, x, way).a > r.a / 2) && u > 0) u /= 2;
    if (!(u > 0)) leaves("the table of heights");
    Segment next{way, 1, std::pow(u, 0.25), end_};
    if (segments_.empty()) next.begin[first] = -way / r.a;  // by v0, at a fixed speed
    return next;
  }
  return {heading_, 1, 0, end_};
}

/// From a body that moves: to the next point, but not over more than half of its energy; or to the
/// turn.
RoadRoll::Segment RoadRoll::onwards() {
  const double x = end_[of_x];
  Segment next{heading_, 0, std::abs(next_point(x, heading_) - x), end_};
  const double E = end_[of_clock];
  const double u = std::sqrt(2 * E);
  highest_ = std::max(highest_, u);
  const Rate r = rate(u, x, heading_);
  if (!(r.N > 0)) leaves("the track");
  if (next.length == 0) leaves("the table of heights");
  if (u <= at_rest * highest_) {
    next.length = 0;
    return next;
  }
  const double changes = bend(u, x, heading_) * E;
  const double slows = -std::max(r.a, rate(least_speed, x, heading_).a);
  if (slows > 0 && E < 2 * next.length * slows && changes < alike * slows * slows) {
    next.change = -1;
    to_speed(next.begin, heading_);
    next.length = next.begin[of_clock];
  } else {
    const double a = std::max(0.0, -r.a);
    next.length = std::min(next.length, E / (a + std::sqrt(a * a + changes)));
  }
  return next;
}

void RoadRoll::add_segment() {
  if (segments_.size() >= most_segments)
    fail("the body creeps: t = {:.6g} s is as far as it can be followed", end_[of_t]);
  Segment next = in_place_ ? onwards() : from_rest();
  heading_ = next.way;
  if (!next.rests()) end_ = along(next, next.begin, next.length);
  const double point = next_point(next.begin[of_x], next.way);
  if (next.of_place() && next.length == std::abs(point - next.begin[of_x])) end_[of_x] = point;
  in_place_ = next.change >= 0;
  if (next.change > 0) to_place(end_, next.way);
  if (next.change < 0) end_[of_clock] = 0;
  segments_.push_back(std::move(next));
}

/// The state by its derivatives at a fixed time, this much later than y, which is hardly more.
RoadRoll::Point RoadRoll::point(const Segment& segment, const State& y, double after) const {
  const bool of_place = segment.of_place();
  const double way = segment.way;
  const double u = segment.speed(y[of_clock]);
  const Rate r = rate(std::max(u, least_speed), y[of_x], way);
  Point p{};
  p.a = segment.rests() ? 0 : way * r.a;
  p.v = segment.rests() ? 0 : way * (u + r.a * after);
  p.x = y[of_x] - x0_ + way * (u + r.a * after / 2) * after;
  const auto set = [&](std::size_t number, double& v_p, double& x_p) {
    const double dt = y[first + 2 * number];
    const double other = y[first + 2 * number + 1];
    x_p = (of_place ? 0 : other) - way * u * dt;
    v_p = way * ((of_place ? other / u : 0) - r.a * dt);
    if (segment.rests()) v_p = 0;
  };
  set(0, p.v_v0, p.x_v0);
  set(1, p.v_x0, p.x_x0);
  for (std::size_t j = 0; j < count_; ++j) set(2 + j, p.v_c[j], p.x_c[j]);
  return p;
}

/// Within a segment the clock is found by Newton's method: from its beginning, or from the time
/// that was asked for before.
RoadRoll::Point RoadRoll::at(double t) {
  const auto rests = [&] { return !segments_.empty() && segments_.back().rests(); };
  while (!rests() && (segments_.empty() || end_[of_t] <= t)) add_segment();
  const auto after =
      std::ranges::upper_bound(segments_, t, {}, [](const Segment& s) { return s.begin[of_t]; });
  const auto number = static_cast<std::size_t>(after - segments_.begin()) - 1;
  const Segment& segment = segments_[number];
  if (segment.rests() || t == segment.begin[of_t]) return point(segment, segment.begin, 0);
  if (here_.empty() || of_here_ != number || here_[of_t] > t) here_ = segment.begin;
  of_here_ = number;
  const bool of_place = segment.of_place();
  const double all = (after == segments_.end() ? end_ : after->begin)[of_t] - segment.begin[of_t];
  for (int i = 0; i < 8; ++i) {
    const double left = t - here_[of_t];
    if (std::abs(left) <= 1e-10 * all) break;
    const double u = segment.speed(here_[of_clock]);
    const double a = rate(std::max(u, least_speed), here_[of_x], segment.way).a;
    const double there =
        of_place ? (u + a * left / 2) * left
                 : segment.change * (std::pow(std::max(u + a * left, 0.0), 0.25) - here_[of_clock]);
    const double begun = of_place ? segment.way * (here_[of_x] - segment.begin[of_x])
                                  : segment.change * (here_[of_clock] - segment.begin[of_clock]);
    here_ = along(segment, here_, std::clamp(there, -begun, segment.length - begun));
  }
  return point(segment, here_, t - here_[of_t]);
}

/// The segment that begins at the first turning point, or the rest; none if that is later than t.
const RoadRoll::Segment* RoadRoll::turn(double t) {
  for (std::size_t i = 0;; ++i) {
    if (i == segments_.size()) {
      if (i > 0 && end_[of_t] > t) return nullptr;
      add_segment();
    }
    const Segment& segment = segments_[i];
    if (segment.begin[of_t] > t) return nullptr;
    if (segment.rests() || segment.change > 0) return &segment;
  }
}

double RoadRoll::stop_until(double t) {
  const Segment* const at = turn(t);
  return at ? at->begin[of_t] : INFINITY;
}

Leg::Derivatives RoadRoll::stop_time_by_c() {
  const Segment& at = *turn(INFINITY);
  Leg::Derivatives by{};
  for (std::size_t j = 0; j < count_; ++j) by[j] = at.begin[first + 2 * (2 + j)];
  return by;
}

}  // namespace rolling
