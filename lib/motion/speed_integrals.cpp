#include "motion/speed_integrals.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rolling {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double shallow = 1e-20;  // for z below it, A = 1 in a double
constexpr double deep = 0.25;      // for z above it, the series needs more than 30 terms
constexpr double least_b = 1e-19;  // for |b| below it, A is constant in a double
constexpr double far = 64;  // what lies beyond y = 64 or s y = 64 does not show in a double, nor in
                            // a rest of 1e-10 of the whole

}  // namespace

SpeedIntegrals::SpeedIntegrals(double b, double K, double depth, double arm_square)
    : arm_{b, K, depth, arm_square}, s_(1 - b) {
  // The rest beyond y = last is negligible.
  const double last = s_ > 0 ? far / std::min(s_, 1.0) : infinity;
  if (depth == 0 || std::abs(b) < least_b) {
    add(0, infinity, SpeedSeries::constant(arm_));
  } else if (b > 0) {
    const double from = std::max(0.0, std::log(depth * depth / deep) / (2 * b));  // z = deep
    add_panels(0, std::min(from, last));
    if (from < last) add(from, infinity, SpeedSeries::binomial(arm_, from));
  } else {
    const double from = std::max(0.0, std::log(shallow / depth / depth) / (-2 * b)),  // z = shallow
        to = std::log(depth) / b;                                                     // z = 1
    if (from > 0) add(0, from < last ? from : infinity, SpeedSeries::binomial(arm_, 0));
    if (from < last) add_panels(from, std::min(to, last));
    if (pieces_.empty()) add(0, 0, SpeedPanel(arm_, 0, 0));  // D(v0) = R: it ends where it begins
    if (to < last) end_ = sums_to_end(pieces_.back()).time;
  }
  if (s_ > 0 && end_ == infinity) add_up_from_stop(last);
}

void SpeedIntegrals::add(double y, double width, std::variant<SpeedPanel, SpeedSeries> integrals) {
  const Sums before = pieces_.empty() ? Sums{} : sums_to_end(pieces_.back());
  pieces_.push_back(
      {y, width, std::exp(-s_ * y), std::move(integrals), before, infinity, infinity});
}

void SpeedIntegrals::add_panels(double from, double to) {
  // Over a panel e^(-s y) changes by at most a factor e and z by at most a factor 2: for b > 0 at
  // least two panels lead z from 1 to 1/4, and for b < 0 |s| is larger than |b|. See SpeedPanel.
  const double count = std::ceil((to - from) * (std::abs(s_) + 2 * std::abs(arm_.b)));
  for (int i = 0; i < count; ++i) {
    const double y = from + (to - from) * i / count, width = (to - from) / count;
    add(y, width, SpeedPanel(arm_, y, width));
  }
}

/// Sums time and lag from the stop backwards, so that the last pieces keep their digits. Beyond the
/// last panel, at y = last, A is assumed constant.
void SpeedIntegrals::add_up_from_stop(double last) {
  const double behind = pieces_.back().width < infinity ? std::exp(-s_ * last) / s_ : 0;
  double rest = f(last) * behind, lag_rest = (1 - f(last)) * behind;
  for (auto p = pieces_.rbegin(); p != pieces_.rend(); ++p) {
    p->rest = rest += p->power * p->time(p->width);
    p->lag_rest = lag_rest += p->power * p->lag(p->width);
  }
  stop_ = rest;
}

double SpeedIntegrals::Piece::time(double local) const {
  return std::visit([=](const auto& range) { return range.time(local); }, integrals);
}

double SpeedIntegrals::Piece::lag(double local) const {
  return std::visit([=](const auto& range) { return range.lag(local); }, integrals);
}

double SpeedIntegrals::Piece::distance(double local) const {
  return std::visit([=](const auto& range) { return range.distance(local); }, integrals);
}

SpeedGradient SpeedIntegrals::Piece::gradient(double local, Wanted wanted) const {
  return std::visit([=](const auto& range) { return range.gradient(local, wanted); }, integrals);
}

const SpeedIntegrals::Piece& SpeedIntegrals::piece_at(double lambda) const {
  const auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), lambda,
                                      [](double y, const Piece& p) { return y < p.y; });
  return *(after - 1);
}

double SpeedIntegrals::lambda(double time, double rest) const {
  const auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), time,
                                      [](double t, const Piece& p) { return t < p.before.time; });
  const Piece& p = *(after - 1);
  const double since =
      rest < time && &p != &pieces_.front() ? std::max(0.0, p.rest - rest) : time - p.before.time;
  return p.y + std::visit(
                   [&](const auto& range) { return range.lambda(since / p.power, rest / p.power); },
                   p.integrals);
}

double SpeedIntegrals::distance(double lambda) const {
  const Piece& p = piece_at(lambda);
  return p.before.gradient.distance + p.power * std::exp(-p.y) * p.distance(p.local(lambda));
}

double SpeedIntegrals::lag(double lambda) const {
  const Piece& p = piece_at(lambda);
  return p.before.lag + p.power * p.lag(p.local(lambda));
}

double SpeedIntegrals::lag_rest(double lambda) const {
  const Piece& p = piece_at(lambda);
  const auto* series = std::get_if<SpeedSeries>(&p.integrals);
  return series && p.width == infinity ? p.power * series->lag_rest(lambda - p.y)
                                       : p.lag_rest - p.power * p.lag(p.local(lambda));
}

SpeedIntegrals::Sums SpeedIntegrals::sums_to_end(const Piece& p) const {
  return {p.before.time + p.power * p.time(p.width), p.before.lag + p.power * p.lag(p.width),
          gradient(p, p.width, Wanted::speed_and_distance)};
}

SpeedGradient SpeedIntegrals::gradient(double lambda, Wanted wanted) const {
  const Piece& p = piece_at(lambda);
  return gradient(p, p.local(lambda), wanted);
}

SpeedGradient SpeedIntegrals::gradient(const Piece& p, double local, Wanted wanted) const {
  SpeedGradient sum = p.gradient(local, wanted);
  if (p.y == 0) return sum;
  // In the terms of `sum`, y counts from the beginning of the piece. For the integrals before the
  // piece, the factor e^-y - e^-lambda has grown by `moved` within it.
  const SpeedGradient& before = p.before.gradient;
  const double unit = std::exp(-p.y), moved = -unit * std::expm1(-local);
  sum.distance = before.distance + p.power * unit * sum.distance;
  sum.g1 = before.g1 + moved * before.h1 + p.power * unit * (sum.g1 + p.y * sum.g0);
  sum.g0 = before.g0 + moved * before.h0 + p.power * unit * sum.g0;
  sum.h1 = before.h1 + p.power * (sum.h1 + p.y * sum.h0);
  sum.h0 = before.h0 + p.power * sum.h0;
  return sum;
}

}  // namespace rolling
