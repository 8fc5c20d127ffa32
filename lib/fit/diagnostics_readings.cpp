// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/diagnostics.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/matrix.h"
#include "base/median.h"
#include "fit/uncertainty.h"
#include "fit/fitted.h"
#include "statistics/levels.h"
#include "least_squares/minimise.h"
#include "statistics/residuals.h"

namespace rolling {
namespace {

/// The readings of one run that are off. If none is, the distance is that of the furthest one.
/// `left` is 1 - leverage. A least-squares fit without reading i has a sum of squares that is
/// smaller by e^2/left; that is the square of the distance of the reading from the fit, too. A
/// robust fit is already the fit of the other readings: without reading i its sum of squares is
/// smaller by e^2, and the variance of its prediction for the reading is that of the noise divided
/// by `left`.
OffReadings off_of_run(const Fitted& fit, std::size_t r, std::span<const double> e,
                       std::span<const double> left, bool robust) {
  const ObservedRun& run = fit.model.runs()[r];
  OffReadings found{r, 0, 0, 0};
  const std::size_t n = e.size();
  double freedom = static_cast<double>(n) - static_cast<double>(fit.parameters().columns());
  const std::size_t most = std::min<std::size_t>(n / 10 + 1, 100);
  const std::size_t runs[] = {n};
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto lost = [&](std::size_t i) { return e[i] * e[i] / (robust ? 1 : left[i]); };
  const auto squared = [&](std::size_t i) { return lost(i) * (robust ? left[i] : 1); };
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(most), order.end(),
                    [&](std::size_t i, std::size_t j) { return squared(i) > squared(j); });
  const double by_chance = std::sqrt(2 * std::log(static_cast<double>(n)));
  std::vector<double> others(e.begin(), e.end());
  double squares = dot(e, e);
  double first = 0;
  for (std::size_t out = 0; out < most && --freedom >= 12;) {
    const std::size_t i = order[out];
    const double off = squared(i);
    squares -= lost(i);
    others[i] = 0;
    if (out++ == 0) first = off;
    const double size = squares > 1e-12 * off ? std::sqrt(off / squares * freedom) : 0;
    if (found.count == 0) found.distance = std::max(found.distance, size);
    if (size < by_chance) break;
    // Smooth residuals are those of another law, which no single reading makes.
    if (size < levels::off || lagged(others, runs, 1) > 0.5 * dot(others, others)) continue;
    const double furthest = std::sqrt(first / squares * freedom);
    found = {r, out, run.origin + run.t[order[0]], furthest};
  }
  return found;
}

/// Around the roll of this fit. In long runs no single reading has a share in it.
OffReadings around(const Fitted& fit, bool robust) {
  const bool is_short = fit.minimum.f.size() <= 1000 * fit.model.runs().size();
  const bool known = fit.noise().known();
  const auto sizes = known ? fit.noise().sources() : fit.model.rows();
  const auto raw = [&](const std::vector<double>& x) {
    return known ? fit.noise().to_sources(x) : x;
  };
  const std::vector<double> e = raw(fit.minimum.f);
  std::vector<double> left(e.size(), 1);
  for (const auto& column : is_short ? orthonormal(fit.system(), fit.minimum) : Matrix())
    std::ranges::transform(left, raw(column), left.begin(),
                           [](double all, double q) { return std::max(all - q * q, 1e-3); });
  OffReadings found{};
  const auto rank = [](const auto& x) { return std::pair(x.count > 0, x.distance); };
  const auto e_of = by_run(e, sizes);
  const auto left_of = by_run(std::as_const(left), sizes);
  for (std::size_t r = 0; r < sizes.size(); ++r) {
    const OffReadings off = off_of_run(fit, r, e_of[r], left_of[r], robust);
    if (rank(off) > rank(found)) found = off;
  }
  return found;
}

}  // namespace

OffReadings off_readings(Fitted fit, bool robust) {
  if (!fit.is_roll() || fit.degrees_left() == 0) return {};
  if (robust) {
    fit.minimum = evaluated(fit.system(), fit.minimum.theta);
    return around(fit, true);
  }
  const OffReadings found = around(fit, false);
  if (found.distance < 5) return {};
  // Readings far off have bent the roll to themselves, away from where it is linear; a robust one
  // follows only those at the ends of a short run.
  try {
    fit.minimum = minimise_robust(fit.system(), {fit.minimum.theta});
    const OffReadings off = off_readings(std::move(fit), true);
    return off.count > 0 ? off : found;
  } catch (const Error&) {
    return found;
  }
}

double few_reversals(const Fitted& fit) {
  if (!fit.is_roll() || fit.noise().known()) return 1;
  double expected = 0;
  unsigned seen = 0;
  const auto residuals = by_run(fit.minimum.f, fit.model.rows());  // model - reading
  for (std::size_t r = 0; r < residuals.size(); ++r) {
    const std::vector<double>& y = fit.model.runs()[r].y;
    const auto f = residuals[r];
    const double sigma = deviation({f.begin(), f.end()});
    for (std::size_t i = 1; i < f.size(); ++i) {
      const double step = y[i] - y[i - 1];
      const double motion = step + f[i] - f[i - 1];
      seen += step * motion <= 0;
      expected += gsl_cdf_ugaussian_P(-std::abs(motion) / (std::numbers::sqrt2 * sigma));
    }
  }
  return expected > 0 ? gsl_cdf_poisson_P(seen, expected) : 1;
}

}  // namespace rolling
