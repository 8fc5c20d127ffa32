#include "motion/law_roll.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "contact/contact.h"

namespace rolling {
namespace {

struct Node {
  double x, weight;
};
/// The 4-point Gauss-Legendre rule on (0, 1).
constexpr Node nodes[] = {{0.06943184420297371, 0.17392742256872693},
                          {0.33000947820757187, 0.32607257743127307},
                          {0.66999052179242813, 0.32607257743127307},
                          {0.93056815579702629, 0.17392742256872693}};

constexpr double widest = 0.25, narrowest = 1e-9;
/// The deceleration falls at most by this factor over a panel; a zero of it is then far away.
constexpr double least_fall = 0.7;
/// The limits below which the remaining time, relative to the elapsed time, or the speed [m/s]
/// counts as 0.
constexpr double negligible = 1e-11, slowest = 1e-250;
constexpr int most_panels = 3000;

}  // namespace

LawRoll::LawRoll(const Body& body, Geometry geometry, const LawInUnits& law, const double* c,
                 double v0)
    : body_(body), geometry_(geometry), law_(law), v0_(v0) {
  std::copy(c, c + law.size(), c_.begin());
  if (!(v0 > 0 && std::isfinite(v0))) fail("the initial velocity {} must be positive", v0);
  q0_ = rate(v0).q;
  if (!(q0_ > 0 && std::isfinite(q0_))) fail("the body does not slow down");
  panel_ = panel_from(v0, q0_, {});
}

LawRoll::Rate LawRoll::rate(double u) const {
  Rate r{};
  const double R = body_.R;
  double D = law_(c_.data(), u, r.q_c.data());
  if (geometry_ == Geometry::exact && D >= R && u < v0_) {
    r.q = body_.g * incline(body_).cos / body_.K;
    return r;
  }
  if (geometry_ == Geometry::exact) check_shift(body_, D);
  const double A = arm_factor(body_, geometry_, D);
  const auto [cos, sin] = incline(body_);
  const double net = D * cos + A * R * sin, arm = body_.K + A, unit = body_.g / R / arm;
  r.q = unit * net;
  const double A_D = geometry_ == Geometry::exact ? -D / (R * R * A) : 0,
               by_D = unit * (cos + A_D * R * sin - net / arm * A_D);
  for (std::size_t j = 0; j < law_.size(); ++j) r.q_c[j] *= by_D;
  r.q_c[law_.size()] = unit * cos * cos * (A * R * cos - D * sin);  // with respect to S = tan theta
  return r;
}

bool LawRoll::add(Sums& sum, double u, double width) const {
  for (const Node& node : nodes) {
    const double at = u * std::exp(-width * node.x);
    const Rate r = rate(at);
    if (!(r.q > 0)) return false;
    const double dt = width * node.weight * at / r.q;
    sum.time += dt;
    sum.distance += at * dt;
    for (std::size_t j = 0; j <= law_.size(); ++j) {
      const double G = dt * r.q_c[j] / r.q;
      sum.G[j] += G;
      sum.U[j] += at * G;
    }
  }
  return true;
}

double LawRoll::time(double u, double width) const {
  double sum = 0;
  for (const Node& node : nodes) {
    const double at = u * std::exp(-width * node.x);
    sum += width * node.weight * at / rate(at).q;
  }
  return sum;
}

LawRoll::Panel LawRoll::panel_from(double u, double q, const Sums& before) const {
  Panel p{u, q, 0, 0, before, before};
  if (u / q <= negligible * before.time || u < slowest) {
    p.u = 0;  // the stop
    return p;
  }
  for (double width = widest; width > narrowest; width /= 2) {
    const double q_end = rate(u * std::exp(-width)).q;
    p.after = before;
    if (q_end > least_fall * q && add(p.after, u, width)) {
      p.width = width;
      p.q_end = q_end;
      break;
    }
  }
  return p;
}

LawRoll::Point LawRoll::point(const Sums& sum, double v, double q) const {
  Point p{v, sum.distance, q / q0_, (v0_ - v) / q0_, {}, {}};
  for (std::size_t j = 0; j <= law_.size(); ++j) {
    p.v_c[j] = -q * sum.G[j];
    p.x_c[j] = v * sum.G[j] - sum.U[j];
  }
  return p;
}

// Derivatives at fixed t, with T and X the integrals for time and distance: dv/dc = q dT/dc = -q G,
// and dx/dc = dX/dc - v dT/dc = v G - U. A larger v0 is equivalent to an earlier beginning: dv/dv0
// = q(v)/q(v0).
LawRoll::Point LawRoll::at(double t) {
  while (panel_.width > 0 && t >= panel_.after.time) {
    if (++panels_ > most_panels) fail("the law is too steep to be rolled");
    const Sums after = panel_.after;
    panel_ = panel_from(panel_.u * std::exp(-panel_.width), panel_.q_end, after);
    asked_ = 0;
  }
  const double since = t - panel_.before.time;
  if (panel_.u == 0) return point(panel_.before, 0, 0);
  if (panel_.width == 0) {  // a constant speed
    Point p = point(panel_.before, panel_.u, panel_.q);
    p.x += p.v * since;
    for (std::size_t j = 0; j <= law_.size(); ++j) p.x_c[j] += p.v_c[j] * since;
    return p;
  }
  if (++asked_ == worth_a_series) {
    const auto f = [this](double at) { return std::bit_cast<Series::Values>(integrated(at)); };
    series_ = Series(0, panel_.after.time - panel_.before.time, f);
  }
  return asked_ < worth_a_series ? integrated(since) : std::bit_cast<Point>(series_(since));
}

LawRoll::Point LawRoll::integrated(double since) const {
  double width = std::clamp(since * panel_.q / panel_.u, 0.0, panel_.width);
  for (int i = 0; i < 10; ++i) {  // Newton's method; the time is nearly linear in the width
    const double u = panel_.u * std::exp(-width),
                 step = (since - time(panel_.u, width)) * rate(u).q / u;
    width = std::clamp(width + step, 0.0, panel_.width);
    if (std::abs(step) < 1e-7) break;  // convergence is quadratic
  }
  Sums sums = panel_.before;
  add(sums, panel_.u, width);
  const double v = panel_.u * std::exp(-width);
  return point(sums, v, rate(v).q);
}

}  // namespace rolling
