// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/diagnostics.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/matrix.h"
#include "fit/errors.h"
#include "fit/fitted.h"
#include "fit/left_out.h"
#include "fit/levels.h"
#include "least_squares/robust.h"

namespace rolling {
namespace {

/// Below this share of its variance in a residual, a reading decides the fit alone.
constexpr double least_left = 1e-3;

/// How far a reading is off the motion of the others, in standard deviations; 0 where the others do
/// not tell.
double size_of(const LeftOut& others, std::size_t i, double freedom) {
  const double left = others.left(i);
  if (left < least_left) return 0;
  const double e = others.residual(i), square = e * e / left, rest = others.squares() - square;
  return rest > 1e-12 * others.squares() ? std::sqrt(square / rest * (freedom - 1)) : 0;
}

std::size_t furthest(const LeftOut& others, const std::vector<bool>& is_out) {
  std::size_t most = 0;
  double largest = -1;
  for (std::size_t i = 0; i < others.rows(); ++i) {
    if (is_out[i]) continue;
    const double x = std::abs(others.residual(i)) / std::sqrt(std::max(others.left(i), least_left));
    if (x > largest) largest = x, most = i;
  }
  return most;
}

/// The correlation of the residuals of the others with those of the reading before.
double correlation_of(const LeftOut& others, const std::vector<bool>& is_out) {
  double sum = 0, squares = 0, before = 0;
  for (std::size_t i = 0; i < others.rows(); ++i) {
    if (is_out[i]) continue;
    const double e = others.residual(i);
    sum += e * std::exchange(before, e), squares += e * e;
  }
  return sum / squares;
}

/// The time is the number of the reading here. Where no reading counts as off, the distance is that
/// of the one that is furthest off.
OffReadings of_run(LeftOut others, double freedom) {
  OffReadings found{};
  const std::size_t n = others.rows(), most = std::min<std::size_t>(n / 10 + 1, 100);
  std::vector<std::size_t> out;
  std::vector<bool> is_out(n);
  const double by_chance = std::sqrt(2 * std::log(static_cast<double>(n)));
  while (out.size() < most && freedom > 12) {
    const std::size_t i = furthest(others, is_out);
    const double size = size_of(others, i, freedom);
    if (found.count == 0) found.distance = std::max(found.distance, size);
    if (size < by_chance) break;
    others.leave_out(i);
    out.push_back(i), is_out[i] = true;
    --freedom;
    // Smooth residuals are those of another law, which no single reading makes.
    if (size < levels::off || correlation_of(others, is_out) > 0.5 ||
        static_cast<double>(n) * gsl_cdf_tdist_Q(size, freedom) > levels::off_chance / 2)
      continue;
    found = {.run = 0, .count = out.size(), .time = 0};
    const double deviation = std::sqrt(std::max(others.squares(), 0.0) / freedom);
    for (const std::size_t k : out)
      if (const double distance = std::abs(others.residual(k)) / deviation;
          distance > found.distance)
        found.distance = distance, found.time = static_cast<double>(k);
  }
  return found;
}

/// Of known filters, the noise of the raw column.
std::vector<double> raw(const Fitted& fit, std::vector<double> x) {
  return fit.noise->from_sources_alone() ? fit.noise->to_sources(std::move(x)) : x;
}

/// The columns that a fit by squares can follow. Of long runs there are none: no single reading has
/// a share in the fit.
Matrix followed(const Fitted& fit) {
  Matrix B;
  if (raw(fit, fit.minimum.f).size() <= 1000 * fit.system.runs.size())
    for (std::vector<double>& column : orthonormal(fit)) B.push_back(raw(fit, std::move(column)));
  return B;
}

/// B: the columns that the fit can follow.
OffReadings around(const Fitted& fit, const Matrix& B) {
  const bool known = fit.noise->from_sources_alone();
  const auto& sizes = known ? fit.noise->sources() : fit.system.runs;
  const std::vector<double> e = raw(fit, fit.minimum.f);
  OffReadings found{};
  const auto rank = [](const OffReadings& x) { return std::pair(x.count > 0, x.distance); };
  const auto e_of = by_run(e, sizes);
  const auto B_of = rows_by_run(B, sizes);
  for (std::size_t r = 0; r < sizes.size(); ++r) {
    const double freedom =
        static_cast<double>(sizes[r]) - static_cast<double>(fit.system.columns());
    if (freedom < 13) continue;
    OffReadings off = of_run({e_of[r], B_of[r]}, freedom);
    if (rank(off) <= rank(found)) continue;
    const ObservedRun& run = fit.model->runs()[r];
    off.run = r;
    auto at = static_cast<std::size_t>(off.time);
    if (run.H && !known)  // the middle of what a filtered reading has read
      at = (run.H->first(at) + run.H->end(at)) / 2;
    off.time = run.origin + run.t[at];
    found = off;
  }
  return found;
}

/// Around the roll of this theta, which is that of a robust fit: single readings have no share in
/// it.
OffReadings around_robust(Fitted fit, const std::vector<double>& theta) {
  fit.minimum = evaluated(fit.system, theta);
  return around(fit, {});
}

}  // namespace

OffReadings off_robust_roll(Route route, const std::vector<FitRun>& runs, FitOptions options) {
  if (!is_trajectory(route) || options.robust) return {};
  options.robust = true;
  try {
    const Fitted fit = fit_route(route, runs, options);
    return around_robust(fit, fit.minimum.theta);
  } catch (const Error&) {
    return {};
  }
}

OffReadings off_readings(const Fitted& fit) {
  if (!fit.is_roll() || fit.degrees_left() == 0) return {};
  const OffReadings found = around(fit, followed(fit));
  if (found.count > 0 || found.distance < 5) return found;
  // A reading far off may have bent the roll to itself, away from where it is linear.
  try {
    return around_robust(fit, minimise_robust(fit.system, {fit.minimum.theta}).theta);
  } catch (const Error&) {
    return {};
  }
}

}  // namespace rolling
