#include "motion/speed_integrals.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/gauss_legendre.h"
#include "motion/increasing_root.h"
#include "motion/power_integral.h"

namespace rolling {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double shallow = 1e-20;  // z below it: A = 1
constexpr double deep = 0.25;      // z above it: the series takes more than 30 terms
constexpr double far = 64;  // what lies beyond y = 64 or s y = 64 does not show in a double, nor in
                            // a rest of 1e-10 of the whole

/// int_0^lambda e^(-s y) dy = time, solved for lambda; rest is 1/s - time for s > 0.
double power_integral_inverse(double s, double time, double rest) {
  if (s > 0 && rest < time) return -std::log(s * rest) / s;
  return s == 0 ? time : -std::log1p(-s * time) / s;
}

}  // namespace

SpeedIntegrals::SpeedIntegrals(double b, double K, double depth, double arm_square)
    : b_(b), s_(1 - b), K_(K), depth_(depth), arm_square_(arm_square) {
  const double none = s_ > 0 ? far / std::min(s_, 1.0) : infinity;  // nothing is left beyond it
  if (depth == 0 || std::abs(b) < 1e-19) {
    add_piece(false, 0, infinity);
    series_ = {{s_, f(0), f(0) / s_, (K + 1 / A(0)) / (K + 1)}};  // A is constant
  } else if (b > 0) {
    const double from = std::max(0.0, std::log(depth * depth / deep) / (2 * b));
    add_panels(0, std::min(from, none));
    if (from < none) add_series(from, infinity);
  } else {
    const double from = std::max(0.0, std::log(shallow / depth / depth) / (-2 * b)),
                 to = std::log(depth) / b;
    if (from > 0) add_series(0, from < none ? from : infinity);
    if (from < none) add_panels(from, std::min(to, none));
    if (pieces_.empty()) add_piece(true, 0, 0);  // D(v0) = R: the roll ends where it begins
    if (to < none) end_ = sums(pieces_.back(), pieces_.back().width).time;
  }
  if (s_ > 0 && end_ == infinity) {
    // Added up from the end, so that the last pieces keep their digits; behind the last panel A is
    // taken as constant.
    const double behind = pieces_.back().panel ? std::exp(-s_ * none) / s_ : 0;
    double rest = f(none) * behind, lag_rest = (1 - f(none)) * behind;
    for (auto p = pieces_.rbegin(); p != pieces_.rend(); ++p) {
      p->rest = rest += p->power * local_time(*p, p->width);
      p->lag_rest = lag_rest += p->power * local_lag(*p, p->width);
    }
    stop_ = rest;
  }
}

double SpeedIntegrals::z(double y) const { return depth_ * depth_ * std::exp(-2 * b_ * y); }

double SpeedIntegrals::A(double y) const {
  return std::sqrt(std::max(0.0, arm_square_ - depth_ * depth_ * std::expm1(-2 * b_ * y)));
}

double SpeedIntegrals::f(double lambda) const {
  return depth_ == 0 ? 1 : (K_ + A(lambda)) / (K_ + 1);
}

void SpeedIntegrals::add_piece(bool panel, double y, double width) {
  const Sums before = pieces_.empty() ? Sums{} : sums(pieces_.back(), pieces_.back().width);
  pieces_.push_back({panel, y, z(y), A(y), width, std::exp(-s_ * y), before, infinity, infinity});
}

void SpeedIntegrals::add_panels(double from, double to) {
  // z and e^(-s y) change by a factor e at most: the 16 nodes leave an error below 1e-17.
  const double count = std::ceil((to - from) * (std::abs(s_) + 2 * std::abs(b_)));
  for (int i = 0; i < count; ++i)
    add_piece(true, from + (to - from) * i / count, (to - from) / count);
}

void SpeedIntegrals::add_series(double from, double to) {
  add_piece(false, from, to - from);
  series_ = {{s_, 1, 1 / s_, 1}};
  double c = 1;  // binom(2n, n) (z/4)^n: 1/A is the sum of c, A that of -c / (2n - 1)
  for (int n = 1; (c *= pieces_.back().z * (2 * n - 1) / (2 * n)) > 1e-18; ++n) {
    const double s = s_ + 2 * b_ * n, f = -c / ((2 * n - 1) * (K_ + 1));
    series_.push_back({s, f, f / s, c / (K_ + 1)});
  }
}

const SpeedIntegrals::Piece& SpeedIntegrals::piece_at(double lambda) const {
  const auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), lambda,
                                      [](double y, const Piece& p) { return y < p.y; });
  return *(after - 1);
}

SpeedIntegrals::Sums SpeedIntegrals::sums(const Piece& p, double y) const {
  const Gradient local = local_gradient(p, y, true);
  const double rho = std::exp(-y), power1 = p.power * std::exp(-p.y);
  const double x0 = local.g0 + rho * local.h0, x1 = local.g1 + rho * local.h1;
  return {p.before.time + p.power * local_time(p, y),
          p.before.lag + p.power * local_lag(p, y),
          p.before.distance + power1 * local.distance,
          p.before.h0 + p.power * local.h0,
          p.before.h1 + p.power * (local.h1 + p.y * local.h0),
          p.before.x0 + power1 * x0,
          p.before.x1 + power1 * (x1 + p.y * x0)};
}

double SpeedIntegrals::lambda(double time, double rest) const {
  const auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), time,
                                      [](double t, const Piece& p) { return t < p.before.time; });
  const Piece& p = *(after - 1);
  const double since =
      rest < time && &p != &pieces_.front() ? std::max(0.0, p.rest - rest) : time - p.before.time;
  return p.y + (p.panel ? panel_lambda(p, since / p.power)
                        : series_lambda(p, since / p.power, rest / p.power));
}

double SpeedIntegrals::distance(double lambda) const {
  const Piece& p = piece_at(lambda);
  return p.before.distance +
         p.power * std::exp(-p.y) * local_distance(p, std::min(lambda - p.y, p.width));
}

double SpeedIntegrals::lag(double lambda) const {
  const Piece& p = piece_at(lambda);
  return p.before.lag + p.power * local_lag(p, std::min(lambda - p.y, p.width));
}

double SpeedIntegrals::lag_rest(double lambda) const {
  const Piece& p = piece_at(lambda);
  const double y = std::min(lambda - p.y, p.width);
  return p.panel || p.width < infinity ? p.lag_rest - p.power * local_lag(p, y)
                                       : p.power * series_lag_rest(y);
}

SpeedIntegrals::Gradient SpeedIntegrals::gradient(double lambda, bool way) const {
  const Piece& p = piece_at(lambda);
  const Gradient local = local_gradient(p, std::min(lambda - p.y, p.width), way);
  if (p.y == 0) return local;
  const double rho = std::exp(-lambda), power1 = p.power * std::exp(-p.y);
  return {p.before.distance + power1 * local.distance, p.before.h0 + p.power * local.h0,
          p.before.h1 + p.power * (local.h1 + p.y * local.h0),
          p.before.x0 - rho * p.before.h0 + power1 * local.g0,
          p.before.x1 - rho * p.before.h1 + power1 * (local.g1 + p.y * local.g0)};
}

/// Calls integrand(y, A, dq) at the nodes with dq = e^(-s y) dA / (b z), times the weight; dy e^(-s
/// y) is A dq.
template <typename Integrand>
void SpeedIntegrals::quadrature(const Piece& p, double width, Integrand&& integrand) const {
  if (width == 0) return;
  const double w_end = -std::expm1(-2 * b_ * width);  // w = 1 - z/p.z
  const double slope = 1 / (p.A + std::sqrt(std::max(0.0, p.A * p.A + p.z * w_end)));
  for (const GaussNode& node : gauss_legendre)
    for (const double x : {node.x, -node.x}) {
      const double dA = slope * p.z * w_end * (1 + x) / 2, A = p.A + dA,
                   w = slope * w_end * (1 + x) / 2 * (A + p.A);
      const double y = -std::log1p(-w) / (2 * b_);
      integrand(y, A, node.weight / 2 * slope * (w_end / b_) / (1 - w) * std::exp(-s_ * y));
    }
}

double SpeedIntegrals::local_time(const Piece& p, double y) const {
  double sum = 0;
  if (p.panel)
    quadrature(p, y, [&](double, double A, double dq) { sum += (K_ + A) / (K_ + 1) * A * dq; });
  else
    for (const Term& term : series_) sum += term.f * power_integral(term.s, y);
  return sum;
}

double SpeedIntegrals::local_lag(const Piece& p, double y) const {
  double sum = 0;
  if (p.panel)
    quadrature(p, y, [&](double, double A, double dq) { sum += (1 - A) / (K_ + 1) * A * dq; });
  else if (series_.size() == 1) sum = (1 - series_[0].f) * power_integral(s_, y);
  else
    for (auto term = series_.begin() + 1; term != series_.end(); ++term)
      sum -= term->f * power_integral(term->s, y);
  return sum;
}

double SpeedIntegrals::series_lag_rest(double y) const {
  if (series_.size() == 1) return (1 - series_[0].f) * std::exp(-s_ * y) / s_;
  double sum = 0;
  const double ratio = std::exp(-2 * b_ * y);
  for (auto term = series_.end() - 1; term != series_.begin(); --term)
    sum = (sum - term->f_by_s) * ratio;
  return sum * std::exp(-s_ * y);
}

double SpeedIntegrals::local_distance(const Piece& p, double y) const {
  double sum = 0;
  if (p.panel)
    quadrature(p, y, [&](double u, double A, double dq) {
      sum += (K_ + A) / (K_ + 1) * A * std::exp(-u) * dq;
    });
  else
    for (const Term& term : series_) sum += term.f * power_integral(term.s + 1, y);
  return sum;
}

SpeedIntegrals::Gradient SpeedIntegrals::local_gradient(const Piece& p, double y, bool way) const {
  Gradient sum{way ? local_distance(p, y) : 0, 0, 0, 0, 0};
  const auto add = [&](double h0, double h1, double g0, double g1) {
    sum.h0 += h0, sum.h1 += h1, sum.g0 += g0, sum.g1 += g1;
  };
  if (p.panel)
    quadrature(p, y, [&](double u, double A, double dq) {
      const double h = (K_ * A + 1) / (K_ + 1) * dq,
                   ahead = way ? -std::exp(-u) * std::expm1(u - y) : 0;
      add(h, u * h, ahead * h, u * ahead * h);
    });
  else
    for (const Term& term : series_) {
      const auto [g0, g1] = way ? headway_integrals(term.s, y) : HeadwayIntegrals{0, 0};
      add(term.h * power_integral(term.s, y), term.h * power_moment(term.s, y), term.h * g0,
          term.h * g1);
    }
  return sum;
}

double SpeedIntegrals::panel_lambda(const Piece& p, double time) const {
  const double all = local_time(p, p.width);
  return increasing_root(0, p.width, p.width * std::clamp(time / all, 0.0, 1.0), [&](double y) {
    const double A_y = A(p.y + y);
    return std::pair(local_time(p, y) - time, (K_ + A_y) / (K_ + 1) * std::exp(-s_ * y));
  });
}

double SpeedIntegrals::series_lambda(const Piece& p, double time, double rest) const {
  const double most = series_[0].f,
               least = series_.size() == 1 ? most : (K_ + p.A) / (K_ + 1);  // f is between
  if (series_.size() > 1 && s_ > 0 && rest < 2 * time) {  // two exponential functions, where a sum
                                                          // of integrals takes one for each term
    // int_y^inf f e^(-s y) dy = e^(-s y) S(z) is nearly a power of the speed: its logarithm is
    // nearly a line.
    const auto inverse = [&](double f) { return std::max(0.0, std::log(f / (s_ * rest)) / s_); };
    const double start = inverse(most);
    return increasing_root(inverse(least), start, start, [&](double y) {
      const double ratio = std::exp(-2 * b_ * y);
      double S = 0, f_y = 0;
      for (auto term = series_.rbegin(); term != series_.rend(); ++term)
        S = S * ratio + term->f_by_s, f_y = f_y * ratio + term->f;
      return std::pair(s_ * y - std::log(S / rest), f_y / S);
    });
  }
  const double start = power_integral_inverse(s_, time / most, rest / most);
  if (series_.size() == 1) return start;
  return increasing_root(start, power_integral_inverse(s_, time / least, infinity), start,
                         [&](double y) {
    double value = -time;
    for (const Term& term : series_) value += term.f * power_integral(term.s, y);
    return std::pair(value, f(p.y + y) * std::exp(-s_ * y));
  });
}

}  // namespace rolling
