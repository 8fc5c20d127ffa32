// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/leg.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "contact/contact.h"

namespace rolling {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double series_tolerance = 1e-14;  // of its last terms; the integral has less
constexpr double narrowest = 2e-15;
constexpr double unseen = 1e-17;      // what is left of a sum below it does not show in a double
constexpr double slowest = 1e-290;    // speeds below it, as a part of v0, count as 0
constexpr double least_part = 1e-40;  // of the time: a smaller part of a coefficient in it is none
constexpr double fastest = 345;       // speeds above v0 e^345 are refused
constexpr double nearly_last = 1e-7;  // part of a last speed below which q is linear
constexpr std::size_t most_panels = 2000;  // beside the corners of the law

/// The r > lo where `above` ceases to hold, by bisection.
template <typename Predicate>
double last_where(double lo, double hi, Predicate&& above) {
  for (;;) {
    const double middle = lo + (hi - lo) / 2;
    if (!(middle > lo && middle < hi)) return hi;
    (above(middle) ? lo : hi) = middle;
  }
}

/// Root between lo and hi of an increasing function: Newton's method from x, bisection where that
/// leaves the bracket. `function` returns value and slope. At most 200 evaluations.
template <typename Function>
double increasing_root(double lo, double hi, double x, Function&& function) {
  const double least = 1e-9 * (hi - lo);
  for (int i = 0; i < 200; ++i) {
    const auto [value, slope] = function(x);
    (value < 0 ? lo : hi) = x;
    double next = x - value / slope;
    if (!(next >= lo && next <= hi)) next = lo + (hi - lo) / 2;
    const double step = std::abs(next - x);
    x = next;
    if (step <= least) break;  // convergence is quadratic
  }
  return x;
}

/// The integral of e^(-m r) from 0 to r, where it ends at the value e.
double integral_of_power(double m, double r, double e) {
  const double y = m * r;
  if (std::abs(y) > 0.5) return (1 - e) / m;
  return y == 0 ? r : -std::expm1(-y) / m;
}

/// The integral of r e^(-m r) from 0 to r.
double integral_of_log(double m, double r, double e) {
  const double y = m * r;
  if (std::abs(y) > 0.3) return (1 - e - y * e) / (m * m);
  double sum = 0;
  double term = 0.5;  // (-y)^k / (k + 2)!
  for (int k = 0; k < 12; ++k) {
    sum += (k + 1) * term;
    term *= -y / (k + 3);
  }
  return r * r * sum;
}

}  // namespace

Leg::Leg(const Body& body, const Law& law, double v0)
    : body_(body), law_(law.in_wind(body.wind)), v0_(v0), incline_(incline(body)), way_(1) {
  if (v0 == 0) {  // a leg of no length, from which nothing moves the end
    end_ = End::stop;
    stop_ = 0;
    q0_ = INFINITY;
    return;
  }
  Rate start = rate(v0);
  if (start.q < 0) {
    way_ = -1;
    start = rate(v0);
  }
  q0_ = std::abs(start.q);
  if (!std::isfinite(q0_)) fail("the deceleration at v0 = {} m/s has no finite value", v0);
  if (q0_ == 0 || start.balanced() || above_last_speed(v0, start) != 0) end_ = End::constant_speed;
  const auto power = law_.power();
  if (!power || body.exact || body.slope != 0 || way_ < 0 || q0_ == 0) return;
  power_ = power->b;
  for (std::size_t j = 0; j < derivatives(); ++j) q_c_[j] = start.q_c[j] / start.q;
  sums_ = closed_sums(-std::log(slowest), slowest);
  if (power->b < 1) {
    end_ = End::stop;
    stop_ = v0_ / q0_ / (1 - power->b);
    sums_[0] = stop_;
  }
}

/// The sums up to r, with u/v0 = e^-r = E there.
Leg::Sums Leg::closed_sums(double r, double E) const {
  const double b = *power_;
  const double unit = v0_ / q0_;
  const double w = std::exp((b - 1) * r);  // part of t that is left until a stop
  Sums sums{};
  for (const int way : {0, 1}) {  // the second time the integrand has another factor u/v0
    const double m = 1 - b + way;
    const double e = way ? w * E : w;
    double* const c = &sums[2 + static_cast<std::size_t>(way) * most];
    const double all = unit * integral_of_power(m, r, e);
    sums[static_cast<std::size_t>(way)] = all;
    c[0] = q_c_[0] * all;
    c[1] = q_c_[1] * all - unit * integral_of_log(m, r, e);          // q_b/q = ln(u/v_unit)
    c[2] = q_c_[2] * unit * integral_of_power(m - b, r, e * w / E);  // q_S is constant
  }
  return sums;
}

/// The state at t: t = v0/q0 (1 - w)/s with s = 1 - b and w = (u/v0)^s.
Leg::Point Leg::closed_point(double t) const {
  const double s = 1 - *power_;
  const double y = q0_ / v0_ * t;
  const double r = s == 0 ? y : -std::log1p(std::max(-s * y, -1.0)) / s;
  const double E = std::exp(-r);
  if (E == 0) return point(sums_, 0, 0);
  return point(closed_sums(r, E), v0_ * E, q0_ * E / (1 - s * y));
}

double Leg::speed(double r) const { return v0_ * std::exp(-way_ * r); }

Leg::Rate Leg::rate(double u) const {
  Rate r{};
  const double R = body_.R;
  auto [D, D_by_log_u] = law_.at(u, r.q_c.data());
  const bool at_radius = body_.exact && D >= R && (u < v0_ || D > R);
  if (at_radius) {
    if (u >= v0_) check_shift(body_, D);
    D = R;
    D_by_log_u = 0;
    r.q_c = {};
  }
  const Acceleration now = accelerate(body_, D, incline_);
  r.q = -way_ * now.a;
  const double by_D = at_radius ? 0 : -way_ * now.by_D;
  r.q_v = by_D * D_by_log_u / u;
  for (std::size_t j = 0; j < law_.size(); ++j) r.q_c[j] *= by_D;
  const double cos = incline_.cos;
  const double by_slope = cos * cos * (now.by_sin * cos - now.by_cos * incline_.sin());
  if (std::isfinite(r.q)) r.q_c[law_.size()] = -way_ * by_slope;
  if (law_.has_drag()) r.q_c[law_.size() + 1] = by_D * law_.by_wind(u);
  const double A = at_radius ? 0 : arm_factor(body_, D);
  const double lift = A * R * body_.slope;
  const double terms_of_net =
      std::abs(D) + std::abs(lift) + std::abs(D_by_log_u) + std::abs(law_.blast());
  r.noise = at_radius ? 1 : terms_of_net / std::abs(D + lift);
  if (body_.exact && !at_radius) r.noise += 1 / (A * A);
  r.steepness = D == 0 ? 0 : std::abs(D_by_log_u / D);
  r.imbalance = terms_of_net > 0 ? std::abs(D + lift) / terms_of_net : 0;
  return r;
}

/// The end of what is smooth beyond r_: a corner of the law, or the end of the leg.
double Leg::next_break() const {
  double next = way_ > 0 ? -std::log(slowest) : fastest;
  const auto corners = law_.corners();
  for (const double v : corners) {
    if (v == 0) continue;
    const double r = way_ * std::log(v0_ / v);
    if (r > r_ + narrowest * (1 + r_)) next = std::min(next, r);
  }
  return next;
}

/// Adds a panel of this length if its series converge. Returns whether they do, and how much longer
/// it might be.
std::pair<bool, double> Leg::try_panel(double width, bool to_radius) {
  Panel p{r_, width, to_radius, sums_, {}, 0, 0};
  double noise = 1;
  double largest = 0;
  bool positive = true;
  const auto rates_at = [&](double z) {
    Sums f{};
    const double u = speed(r_ + p.r_of(z));
    const double E = u / v0_;
    const Rate at = rate(u);
    // A rounding of r is one of ln u, which a steep law makes larger.
    if (!to_radius) noise = std::max(noise, at.noise + at.steepness * (1 + r_));
    positive &= at.q > 0;
    const double dt = u / at.q * (to_radius ? 2 * (1 - z / width) : 1);
    f[0] = dt;
    f[1] = E * dt;
    for (std::size_t j = 0; j < derivatives(); ++j) {
      f[2 + j] = dt * at.q_c[j] / at.q;
      f[2 + most + j] = E * f[2 + j];
    }
    return f;
  };
  const Series rates(0, width, rates_at);
  if (!positive) return {false, 0.5};
  for (std::size_t i = 0; i < values; ++i) {
    const double scale = rates.largest(i) + std::abs(sums_[i]) / width;
    const std::size_t j = (i - 2) % most;                         // of a derivative
    if (i >= 2 && j > law_.size() && law_.wind() == 0) continue;  // smooth if the others are
    const double c = i >= 2 && j < law_.size() && law_.c(j) != 0 ? std::abs(law_.c(j)) : 1;
    if (c * scale > least_part * rates.largest(i < 2 ? i : 0))
      largest = std::max(largest, rates.last(i) / scale);
  }
  const double allowed = series_tolerance + 4 * eps * noise;
  // Terms that are rounding alone do not tell how much longer the panel might be.
  const double factor = largest <= 4 * eps * noise
                            ? 3
                            : std::clamp(0.9 * std::pow(allowed / largest, 1.0 / terms), 0.1, 3.0);
  if (!(largest <= allowed) && width > narrowest * (1 + r_)) return {false, factor};
  p.sums = rates.integral();
  p.begin = rates(0)[0];
  p.decay = to_radius ? 0 : std::log(p.begin / rates(width)[0]) / width;
  const Sums over = p.sums(width);
  for (std::size_t i = 0; i < values; ++i) sums_[i] += over[i];
  panels_.push_back(p);
  return {true, factor};
}

/// A last speed that is negligible counts as rest.
void Leg::end_at_last_speed() {
  end_ = End::constant_speed;
  if (way_ < 0 || speed(r_) >= negligible * v0_) return;
  end_ = End::stop;
  stop_ = sums_[0];
  rest_ = speed(r_);
}

void Leg::add_panel() {
  if (panels_.size() > most_panels + law_.corners().size())
    fail("the law is too steep to be rolled");
  const double limit = next_break();
  double width = width_;
  for (;;) {
    double to = std::min(r_ + width, limit);
    const auto below = [&](double r) { return law_.at(speed(r)).D < body_.R; };
    const bool deepens = body_.exact && radius_time_ == INFINITY && !below(to);
    if (deepens) to = last_where(r_, to, below);
    if (deepens && to - r_ <= narrowest * (1 + r_)) {
      reach_radius();
      continue;
    }
    if (to - r_ <= narrowest * (1 + r_) && rate(speed(to)).q <= 0) return end_at_last_speed();
    const auto [converges, factor] = try_panel(to - r_, deepens);
    if (converges) {
      r_ = to;
      width_ = (to < limit || deepens ? to - panels_.back().r : width) * std::max(factor, 0.2);
      if (deepens) reach_radius();
      break;
    }
    const double least = narrowest * (1 + r_);
    if (!(to - r_ > least)) fail("the deceleration has no value near v = {} m/s", speed(r_));
    width = std::max((to - r_) * std::min(factor, 0.7), least / 2);
  }
  const double u = speed(r_);
  const Rate now = rate(u);
  if (now.balanced() || !(now.q > 0) || above_last_speed(u, now) != 0) end_at_last_speed();
  else if (way_ < 0 && r_ >= fastest) end_ = End::too_fast;
  if (end_ != End::none || way_ < 0) return;
  const double left = u / now.q;
  if (left <= unseen * sums_[0] || u <= 1.1 * slowest * v0_) {
    // The rest of the way follows the power of v that q has there.
    const Shift s = law_.at(u);
    const double power = body_.slope == 0 && s.D < body_.R ? s.by_log_v / s.D : 0;
    end_ = power < 1 ? End::stop : End::constant_speed;
    if (power < 1) stop_ = sums_[0] + left / (1 - power);
  }
}

void Leg::reach(double t) {
  if (power_) return;
  while (end_ == End::none && sums_[0] <= t) add_panel();
}

Leg::Point Leg::point(const Sums& sum, double v, double q) const {
  Point p{.v = v, .x = v0_ * sum[1], .a = -way_ * q, .v_v0 = 1};
  if (q0_ > 0) {
    p.v_v0 = q / q0_;
    p.x_v0 = std::abs(v0_ - v) / q0_;
  }
  for (std::size_t j = 0; j < derivatives(); ++j) {
    p.v_c[j] = -way_ * q * sum[2 + j];
    p.x_c[j] = v * sum[2 + j] - v0_ * sum[2 + most + j];
  }
  return p;
}

/// By how much the speed u is above the last one, if it is nearly that; else 0.
double Leg::above_last_speed(double u, const Rate& at) const {
  const bool nears =
      at.q > 0 && !at.balanced() && at.imbalance < 1e-6 && at.q < nearly_last * way_ * at.q_v * u;
  return nears ? at.q / at.q_v : 0;
}

/// By v' = -way q_v (v - u) with the last speed u. The derivatives follow from
/// v_c' = -way (q_v v_c + q_c), where q_v and q_c, too, are linear functions of the speed.
Leg::Point Leg::beyond_panels(double since) const {
  const double v = speed(r_);
  const Rate now = rate(v);
  const double above = above_last_speed(v, now);
  Point p = point(sums_, v, now.q);
  const Rate last = rate(v - above);
  // At an unstable balance the derivatives grow without bound, but not beyond a double.
  const double k = way_ * last.q_v;
  const double s = k < 0 ? std::min(since, fastest / -k) : since;
  const double fade = std::exp(-k * s);
  const double once = integral_of_power(k, s, fade);
  const double of_log = integral_of_log(k, s, fade);
  const double twice = s * once - of_log;
  p.v = v - above * (1 - fade);
  p.x += (v - above) * since + above * once;
  p.a *= fade;
  p.x_v0 += p.v_v0 * once;
  p.v_v0 *= fade;
  for (std::size_t j = 0; j < derivatives(); ++j) {
    const double change = above == 0 ? 0 : now.q_c[j] - last.q_c[j] * now.q_v / last.q_v;
    p.x_c[j] += p.v_c[j] * once - way_ * (last.q_c[j] * twice + change * of_log);
    p.v_c[j] = p.v_c[j] * fade - way_ * (last.q_c[j] * once + change * s * fade);
  }
  return p;
}

Leg::Point Leg::at(double t) {
  if (t == 0 && v0_ > 0) return point({}, v0_, q0_);
  reach(t);
  if (t >= stop_) {
    Point p = point(sums_, rest_, 0);
    p.v = 0;
    return p;
  }
  if (power_) return closed_point(t);
  if (t >= sums_[0]) {
    if (end_ == End::too_fast) fail("the speed has grown by a factor e^{}", fastest);
    // The last part before a stop does not show in x.
    return end_ == End::stop ? point(sums_, speed(r_), 0) : beyond_panels(t - sums_[0]);
  }
  const auto after =
      std::upper_bound(panels_.begin() + 1, panels_.end(), t,
                       [](double time, const Panel& p) { return time < p.before[0]; });
  const Panel& p = *(after - 1);
  // The starting point assumes that the time per r is an exponential function over the panel.
  const double since = t - p.before[0];
  const double part = p.decay * since / p.begin;
  const double start = std::abs(part) < 1e-8 ? since / p.begin : -std::log1p(-part) / p.decay;
  const double z = increasing_root(0, p.width, start >= 0 && start <= p.width ? start : p.width / 2,
                                   [&](double at) {
    const auto [value, per_z] = p.sums.value_and_slope(0, at);
    return std::pair(value - since, per_z);
  });
  Sums sum = p.sums(z);
  for (std::size_t i = 0; i < values; ++i) sum[i] += p.before[i];
  const double v = speed(p.r + p.r_of(z));
  return point(sum, v, rate(v).q);
}

double Leg::stop_time() {
  if (way_ < 0) return INFINITY;
  // A level mat under a power of v that is not below 1 never stops the body.
  if (body_.slope == 0 && end_ == End::none) {
    const Shift s = law_.at(v0_ * 1e-3);
    if (law_.at_rest() == 0 && s.by_log_v >= s.D) return INFINITY;
  }
  reach(INFINITY);
  return stop_;
}

double Leg::stop_until(double t) {
  reach(t);
  return stop_ <= t ? stop_ : INFINITY;
}

double Leg::radius_time(double t) {
  if (!body_.exact) return INFINITY;
  reach(t);
  return radius_time_;
}

double Leg::last_speed() {
  if (way_ < 0 || body_.slope < 0 || law_.wind() != 0) reach(INFINITY);
  const double v = speed(r_);
  if (end_ == End::constant_speed) return v - above_last_speed(v, rate(v));
  return end_ == End::too_fast ? INFINITY : 0;
}

Leg::Derivatives Leg::stop_time_by_c() {
  reach(INFINITY);
  Derivatives by{};
  for (std::size_t j = 0; j < derivatives(); ++j) by[j] = -sums_[2 + j];
  return by;
}

}  // namespace rolling
