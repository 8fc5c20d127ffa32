// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/diagnostics.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/matrix.h"
#include "fit/fitted.h"
#include "fit/levels.h"
#include "least_squares/robust.h"
#include "statistics/residuals.h"

namespace rolling {
namespace {

/// The time is the number of the reading here. Where no reading counts as off, the distance is that
/// of the one that is furthest off.
OffReadings of_run(std::span<const double> e, double freedom) {
  OffReadings found{};
  const std::size_t n = e.size(), most = std::min<std::size_t>(n / 10 + 1, 100), runs[] = {n};
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::partial_sort(order, order.begin() + static_cast<std::ptrdiff_t>(most),
                            std::greater(), [&](std::size_t i) { return std::abs(e[i]); });
  const double by_chance = std::sqrt(2 * std::log(static_cast<double>(n)));
  std::vector<double> others(e.begin(), e.end());
  for (std::size_t out = 0; out < most && --freedom >= 12;) {
    const double off = std::abs(e[order[out]]);
    others[order[out++]] = 0;
    const double squares = dot(others, others),
                 size = squares > 1e-12 * off * off ? off / std::sqrt(squares / freedom) : 0;
    if (found.count == 0) found.distance = std::max(found.distance, size);
    if (size < by_chance) break;
    // Smooth residuals are those of another law, which no single reading makes.
    if (size < levels::off || lagged(others, runs, 1) > 0.5 * squares ||
        static_cast<double>(n) * gsl_cdf_tdist_Q(size, freedom) > levels::off_chance / 2)
      continue;
    found = {.run = 0,
             .count = out,
             .time = static_cast<double>(order[0]),
             .distance = std::abs(e[order[0]]) / std::sqrt(squares / freedom)};
  }
  return found;
}

OffReadings around(const Fitted& fit) {
  const bool known = fit.noise->known();
  const auto& sizes = known ? fit.noise->sources() : fit.system.runs;
  const std::vector<double> e = known ? fit.noise->to_sources(fit.minimum.f) : fit.minimum.f;
  OffReadings found{};
  const auto rank = [](const OffReadings& x) { return std::pair(x.count > 0, x.distance); };
  const auto e_of = by_run(e, sizes);
  for (std::size_t r = 0; r < sizes.size(); ++r) {
    const double freedom =
        static_cast<double>(sizes[r]) - static_cast<double>(fit.system.columns());
    OffReadings off = of_run(e_of[r], freedom);
    if (rank(off) <= rank(found)) continue;
    const ObservedRun& run = fit.model->runs()[r];
    off.run = r;
    off.time = run.origin + run.t[static_cast<std::size_t>(off.time)];
    found = off;
  }
  return found;
}

/// Around the roll of this theta, which is that of a robust fit.
OffReadings around_robust(Fitted fit, const std::vector<double>& theta) {
  fit.minimum = evaluated(fit.system, theta);
  return around(fit);
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
  const OffReadings found = around(fit);
  if (found.count > 0 || found.distance < 5) return found;
  // A reading far off may have bent the roll to itself, away from where it is linear.
  try {
    return around_robust(fit, minimise_robust(fit.system, {fit.minimum.theta}).theta);
  } catch (const Error&) {
    return {};
  }
}

}  // namespace rolling
