#include "motion/slope_integrals.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "motion/gauss_legendre.h"
#include "motion/increasing_root.h"

namespace rolling {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double far = 42;  // a relative change e^-42 of a sum is below the rounding of a double
constexpr double fastest = 300;  // speeds above v0 e^300 are refused
// Numbers below these bounds count as 0 or are raised to the bound, so that no quotient overflows.
// The effect is below the rounding of a double: v^b is 1 for every speed, or d or net is far below
// the other term. On a slope a depth below its bound is continued by fade_.
constexpr double least_b = 1e-19, least_slope = 1e-200;
constexpr double least_net = 1e-100, least_depth = 1e-290;
constexpr double least_pole = 1e-6;        // the time in which A grows to it is 1e-12 of the whole
constexpr double negligible_part = 1e-20;  // of the net force: no digit of a sum shows it
constexpr double least_part = 1e-17;  // the panels towards a last speed end at this part of the way
constexpr double negligible = 1e-6;   // last speeds below it, as a part of v0, count as rest:
constexpr double rest_left = std::numbers::ln2;  // the stop is at twice the last speed
// The 16 nodes have an error below 1e-17 if an exponential function changes by e^12 over the panel,
// and if the integrand is analytic within an ellipse 3.4 times as large as the half panel: a
// singularity on the line is then 0.85 half panels away from the end of the panel, and one beside
// it 1.5.
constexpr double most_decay = 12, ahead = 0.7, behind = 1.3;

}  // namespace

SlopeIntegrals::SlopeIntegrals(Geometry geometry, double b, double K, double depth,
                               double arm_square, double slope, double log_depth)
    : exact_(geometry == Geometry::exact), b_(std::abs(b) < least_b ? 0 : b), K_(K),
      depth_(std::max(depth, least_depth)), arm_square_(exact_ ? arm_square : 1),
      slope_(std::abs(slope) < least_slope ? 0 : slope),
      sine_(exact_ ? std::abs(slope_) / std::hypot(1, slope_) : std::abs(slope_)),
      fade_(slope_ == 0 || depth >= least_depth ? 0 : log_depth - std::log(least_depth)),
      way_(depth_ * std::exp(fade_) + std::sqrt(arm_square_) * slope_ >= 0 ? 1 : -1),
      beta_(way_ * b_) {
  crossing_ = b_ == 0 ? infinity : r_of_depth(sine_);
  // For b > 0 the body tends to the speed where net = 0, for b < 0 it leaves that speed: crossing_
  // has the sign of b, also where rounding has moved it to the other side of v0.
  if (b_ != 0 && slope_ < 0) crossing_ = std::copysign(std::max(std::abs(crossing_), 1e-16), b_);
  deep_end_ = b_ == 0 ? infinity : r_of_depth(0.5);

  double last = horizon(), left = slope_ < 0 ? crossing_ : infinity;
  bool stops = way_ > 0 && (slope_ != 0 || b_ < 1);
  if (slope_ < 0 && b_ > 0 && (way_ > 0 || crossing_ < fastest)) {
    last_speed_ = std::exp(-way_ * crossing_);
    stops = way_ > 0 && last_speed_ < negligible;
    last = stops ? std::min(last, crossing_ - rest_left) : infinity;
  } else if (way_ < 0) {
    last_speed_ = infinity;
  } else if (b_ == 0 && depth_at(0) + arm(0) * slope_ <= least_net) {
    last_speed_ = 1, stops = false;
  }
  if (stops) rest_speed_ = 2 * std::exchange(last_speed_, 0);
  if (exact_ && way_ > 0 && b_ < 0 && r_of_depth(1) <= last) {
    last = r_of_depth(1);  // D = R
    stops = false, end_ = 0;
  }
  add_panels(last, left);
  const Panel& end = panels_.back();
  if (end_ == 0) end_ = end.before.time + end.duration;
  // The time to the stop is summed from the end, so that the last panels keep their digits.
  double rest = stops ? 0 : infinity;
  for (auto p = panels_.rbegin(); p != panels_.rend(); ++p) p->rest = rest += p->duration;
  stop_ = rest;
}

/// Panels from v0 to r = last, or until almost nothing is left of the way to the speed where net =
/// 0.
void SlopeIntegrals::add_panels(double last, double left) {
  const double least_left = std::min(std::abs(left), 1.0) * least_part;
  for (double r = 0; r < last && std::abs(left) > least_left;) {
    double part = width(r, left);
    if (r < deep_end_ && r + part > deep_end_) part = deep_end_ - r;
    const bool done = r + part >= last;
    if (done) part = last - r;
    add_panel(r, left, part);
    r = done ? last : r + part;
    left -= part;
  }
  if (panels_.empty()) add_panel(0, left, 0);
}

/// The r beyond which the remaining time is below the rounding of a double, or which no time
/// reaches.
double SlopeIntegrals::horizon() const {
  if (way_ < 0) return fastest;
  const double s = 1 - b_, crossing = std::max(crossing_, 0.0);
  // For b >= 1 the body never stops on a level mat: to times of e^600, or the least double of
  // speed.
  if (slope_ == 0) return s > 0 ? far / s : std::min(745.0, s < 0 ? -2 * fastest / s : infinity);
  if (slope_ < 0) return s > 0 ? far / s : infinity;
  if (b_ <= 0)  // d grows as the body slows down
    return crossing < far && b_ < 0 ? crossing + (far - crossing) / s : far;
  return s * crossing >= far ? far / s : crossing + far - std::max(s, 0.0) * crossing;
}

/// The largest length of a panel that begins at r. The fastest exponential decay of an integrand
/// and the nearest singularity limit it.
double SlopeIntegrals::width(double r, double left) const {
  const double size = std::abs(b_), s = std::abs(1 - b_);
  const bool past = slope_ > 0 && b_ > 0 && r > crossing_,
             faded = beta_ > 0 && r - crossing_ > 46 / size;  // d is below 1e-20 of the slope's
  // The factors are E for the time, one E more for the distance (which beyond `far` adds nothing),
  // and d/net for the derivative by ln a.
  const double decay = way_ < 0 ? 2 + (faded ? 0 : 2 * size)
                       : faded  ? 1 + (r < far ? 1 : 0)
                                : std::max(s, past ? 1.0 : 0.0) + (r < far ? 1 + size : 0);
  double limit = most_decay / decay;
  if (b_ == 0) return limit;
  if (slope_ != 0) {
    // net = 0 at crossing_ for S < 0, and at crossing_ +- i pi/b for S > 0.
    const double gap = slope_ < 0 ? left : crossing_ - r;
    limit = std::min(limit, std::max(slope_ > 0 ? behind * std::numbers::pi / size : 0,
                                     gap > 0 ? ahead * gap : -behind * gap));
  }
  if (!exact_) return limit;
  // Where A is the variable, z = d^2 changes by at most a factor 2 = e^(2/3): see SpeedPanel.
  if (beta_ > 0 ? r < deep_end_ : r >= deep_end_)
    return std::min({limit / 2, 1 / (3 * size), width_by_arm(r)});
  const double root = r_of_depth(1);  // A = 0
  return std::min(limit, root > r ? ahead * (root - r) : behind * (r - root));
}

/// The largest length of a panel with A as the variable on a rising mat: net = 0 at A =
/// -cos(theta), which on a steep mat is close to A = 0.
double SlopeIntegrals::width_by_arm(double r) const {
  if (slope_ <= 0) return infinity;
  const double A = arm(r), gap = A + std::max(1 / std::hypot(1, slope_), least_pole),
               end = beta_ > 0 ? A + behind * gap : A - ahead * gap;
  if (end < 0 || end >= 1) return infinity;
  return std::log1p((A - end) * (A + end) / (1 - A * A)) / (-2 * beta_);
}

double SlopeIntegrals::arm(double r) const {
  if (!exact_) return 1;
  const double exponent = b_ == 0 ? 0 : -2 * beta_ * r, d = exponent > 0 ? depth_at(r) : depth_;
  const double growth = d * d * (exponent > 0 ? -std::expm1(-exponent) : std::expm1(exponent));
  return std::sqrt(std::max(0.0, arm_square_ - growth));
}

/// |d + A S|. Near its zero from what is left to it, d = sine e^(beta left), without cancellation.
double SlopeIntegrals::net(double d, double A, double left) const {
  if (slope_ < 0 && std::abs(beta_ * left) < 1) {
    const double line = sine_ * std::expm1(beta_ * left);
    if (!exact_) return std::abs(line);
    return std::abs(line - slope_ * sine_ * sine_ * std::expm1(2 * beta_ * left) /
                               (1 / std::hypot(1, slope_) + A));
  }
  return std::max(std::abs(d + A * slope_), slope_ < 0 ? least_net : 0);
}

void SlopeIntegrals::add_panel(double r, double left, double width) {
  const double middle = r + width / 2;
  const bool deep = exact_ && b_ != 0 && (beta_ > 0 ? middle < deep_end_ : middle > deep_end_);
  Panel p{r, width, left, deep, arm(r), 0, 0, 0, {}, 0};
  if (!panels_.empty()) {
    const Panel& last = panels_.back();
    p.before = total(last, last.width, local(last, last.width, Wanted::speed_and_distance));
    panels_.back().duration = p.before.time - last.before.time;
  }
  p.begin = time_per_r(p, 0);
  p.decay = width > 0 ? std::log(p.begin / time_per_r(p, width)) / width : 0;
  panels_.push_back(p);
  panels_.back().duration = local_time(p, width);
}

/// Calls integrand(node) at the nodes of the first `width` of the panel.
template <typename Integrand>
void SlopeIntegrals::quadrature(const Panel& p, double width, Integrand&& integrand) const {
  if (width <= 0) return;
  const auto at = [&](double local, double A, double dr, double dr_by_A) {
    const double r = p.r + local, d = depth_at(r);
    const double n = net(d, A, p.left - local);
    integrand(Node{r, local, E_by_net(r, d, n), d, A, n, dr, dr_by_A});
  };
  if (!p.deep) {
    for (const auto& [x, weight] : gauss_legendre) {
      const double local = width / 2 * (1 + x), A = exact_ ? arm(p.r + local) : 1,
                   dr = weight / 2 * width;
      at(local, A, dr, dr / A);
    }
    return;
  }
  // dA/dr = beta z/A with z = d^2 = 1 - A^2, and r from A by ln(z), both without cancellation.
  const double z = 1 - p.A * p.A, rise = -z * std::expm1(-2 * beta_ * width);
  const double slope = rise / (p.A + std::sqrt(std::max(0.0, p.A * p.A + rise)));
  for (const auto& [x, weight] : gauss_legendre) {
    const double dA = slope * (1 + x) / 2, A = p.A + dA, w = dA * (A + p.A) / z;
    const double dr_by_A = weight / 2 * slope / (beta_ * z * (1 - w));
    at(std::log1p(-w) / (-2 * beta_), A, A * dr_by_A, dr_by_A);
  }
}

/// E/|net| at r, from E/d, which is one power, since E and d may both underflow; where d is
/// negligible beside the slope's part, directly.
double SlopeIntegrals::E_by_net(double r, double d, double net) const {
  if (slope_ != 0 && d < negligible_part * net) return std::exp(-way_ * r) / net;
  const double E_by_d = std::exp(-way_ * (1 - b_) * r - fade_) / depth_;
  return slope_ == 0 ? E_by_d : E_by_d * (d / net);
}

/// E (K + A)/|net| at r from the beginning of the panel.
double SlopeIntegrals::time_per_r(const Panel& p, double r) const {
  const double at = p.r + r, A = arm(at), d = depth_at(at);
  return E_by_net(at, d, net(d, A, p.left - r)) * (K_ + A);
}

/// The time over the first `r` of the panel.
double SlopeIntegrals::local_time(const Panel& p, double r) const {
  double sum = 0;
  quadrature(p, r, [&](const Node& n) { sum += n.E_by_net * (K_ + n.A) * n.dr; });
  return sum;
}

/// All integrals over the first `width` of the panel.
SlopeIntegrals::Sums SlopeIntegrals::local(const Panel& p, double width, Wanted wanted) const {
  Sums sum;
  quadrature(p, width, [&](const Node& n) {
    const double part = slope_ == 0 ? 1 : n.d / n.net, dt = n.E_by_net * (K_ + n.A) * n.dr;
    const double h = n.E_by_net * part *
                     (exact_ ? (K_ * n.A + 1 - slope_ * K_ * n.d) * n.dr_by_A : (K_ + 1) * n.dr);
    const double k = dt * n.A / n.net;
    sum.time += dt;
    sum.h0 += h, sum.h1 += h * n.r, sum.k0 += k;
    if (wanted == Wanted::speed) return;
    const double E = std::exp(-way_ * n.r),
                 E_left = E * std::abs(std::expm1(way_ * (n.local - width)));
    sum.distance += dt * E;
    sum.g0 += h * E_left, sum.g1 += h * n.r * E_left, sum.j += k * E_left, sum.w += dt * E_left;
  });
  return sum;
}

/// The integrals from r = 0 to `r` within the panel. For those with the factor |E - E(end)| the end
/// moves from the beginning of the panel on.
SlopeIntegrals::Sums SlopeIntegrals::total(const Panel& p, double r, const Sums& local) const {
  const Sums& b = p.before;
  const double moved = std::exp(-way_ * p.r) * std::abs(std::expm1(-way_ * r));
  Sums sum = local;
  sum.time += b.time, sum.distance += b.distance;
  sum.h0 += b.h0, sum.h1 += b.h1, sum.k0 += b.k0;
  sum.g0 += b.g0 + moved * b.h0, sum.g1 += b.g1 + moved * b.h1;
  sum.j += b.j + moved * b.k0, sum.w += b.w + moved * b.time;
  return sum;
}

SlopeIntegrals::Place SlopeIntegrals::place(double time, double rest) const {
  const bool from_end = rest < time;
  const auto after = std::partition_point(panels_.begin() + 1, panels_.end(), [&](const Panel& p) {
    return from_end ? p.rest >= rest : p.before.time <= time;
  });
  const Panel& p = *(after - 1);
  const auto i = static_cast<std::size_t>(after - 1 - panels_.begin());
  const double since = std::max(0.0, from_end ? p.rest - rest : time - p.before.time);
  if (since >= p.duration) {
    if (after == panels_.end() && way_ < 0 && last_speed_ == infinity)
      fail("the speed has grown by a factor e^{}", fastest);
    return {i, p.width, after == panels_.end() && last_speed_ > 0 ? since - p.duration : 0};
  }
  // The starting point assumes that the time per r is an exponential function between the ends of
  // the panel.
  const double q = p.decay * since / p.begin,
               start = std::abs(q) < 1e-8 ? since / p.begin : -std::log1p(-q) / p.decay;
  const double r = increasing_root(
      0, p.width, start >= 0 && start <= p.width ? start : p.width / 2,
      [&](double y) { return std::pair(local_time(p, y) - since, time_per_r(p, y)); });
  return {i, r};
}

double SlopeIntegrals::start_rate() const {
  return net(depth_at(0), arm(0), panels_.front().left) / (K_ + arm(0));
}

double SlopeIntegrals::speed(Place at) const {
  return std::exp(-way_ * (panels_[at.panel].r + at.r));
}

SlopeIntegrals::Gradient SlopeIntegrals::gradient(Place at, Wanted wanted) const {
  const Panel& p = panels_[at.panel];
  const Sums sum = total(p, at.r, local(p, at.r, wanted));
  const double r = p.r + at.r, A = arm(r), n = net(depth_at(r), A, p.left - at.r);
  return {n / (K_ + A), std::abs(std::expm1(-way_ * r)),
          sum.time,     sum.distance,
          sum.h0,       sum.h1,
          sum.k0,       sum.g0,
          sum.g1,       sum.j,
          sum.w};
}

}  // namespace rolling
