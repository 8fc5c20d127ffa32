// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/routes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"

namespace rolling {

namespace {

/// The starts of a search in many runs: of several the one that leads to the smallest minimum in a
/// few of the runs, with the law that it finds there.
std::vector<std::vector<double>> narrowed(const Fitted& fit,
                                          std::vector<std::vector<double>> starts) {
  constexpr std::size_t few = 8;
  const std::size_t n = fit.model.runs().size();
  if (n <= few) return starts;
  std::vector<ObservedRun> runs;
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < few; ++k) chosen.push_back(k * n / few);
  for (const std::size_t run : chosen) runs.push_back(fit.model.runs()[run]);
  const Model model(std::move(runs), fit.parameters().of_runs(few));
  const System system = system_of(model.weighted(fit.noise().added()));
  Minimum best;
  for (const std::vector<double>& start : starts)
    improve(best, system, fit.parameters().theta_of_runs(start, chosen));
  if (!std::isfinite(best.rss)) return starts;
  std::copy_backward(best.theta.end() - static_cast<std::ptrdiff_t>(system.shared),
                     best.theta.end(), starts.front().end());
  starts.resize(1);
  return starts;
}

/// The start with the best of the other parameters at its x0. Where speeds tell x0, a search from a
/// law that is far off would leave the place where the runs begin.
std::vector<double> with_x0_held(const Fitted& fit, const std::vector<double>& start) {
  const Parameters& q = fit.parameters();
  std::vector<ObservedRun> runs = fit.model.runs();
  std::vector<double> held = start;
  for (std::size_t r = runs.size(); r-- > 0;) {
    runs[r].x0 = q.x0(start, r);
    held.erase(held.begin() + static_cast<std::ptrdiff_t>((r + 1) * q.own() - 1));
  }
  Minimum best{held};
  const Model model(std::move(runs), q.with(1, 0));
  improve(best, system_of(model.weighted(fit.noise().added())), held);
  for (std::size_t place = q.own() - 1; place < start.size() - q.shared(); place += q.own())
    best.theta.insert(best.theta.begin() + static_cast<std::ptrdiff_t>(place), start[place]);
  return best.theta;
}

}  // namespace

Fitted fit_beside(const Fitted& power, const LawForm& law, const FitOptions::Fixed& fixed) {
  Fitted fit{};
  const double v = power.fastest();
  fit.model = power.model.with(power.parameters().with(law, power.law()(v), v, fixed));
  std::vector<std::vector<double>> starts;
  for (const auto& c : law.starts) {
    std::vector<double> theta = power.minimum.theta;  // its v0, x0 and scene, without a wind
    const auto first = theta.end() - static_cast<std::ptrdiff_t>(power.parameters().shared());
    const auto end = theta.end() - static_cast<std::ptrdiff_t>(power.scene.size());
    const std::vector<double> start = fit.parameters().start(c);
    theta.insert(theta.erase(first, end), start.begin(), start.end());
    if (!fit.parameters().fits(place_of_wind)) {
      starts.push_back(std::move(theta));
      continue;
    }
    for (const double part : {-0.1, 0.0, 0.1}) {
      starts.push_back(theta);
      starts.back().push_back(part * v / scene_numbers[place_of_wind].unit);
    }
  }
  starts = narrowed(fit, std::move(starts));
  if (fit.parameters().has_x0() && !fit.parameters().of_positions())
    for (std::vector<double>& start : starts) start = with_x0_held(fit, start);
  for (const auto& start : starts) improve(fit.minimum, fit.system(), start);
  if (was_found(fit)) read_off(fit);
  return fit;
}

namespace {

/// Fits a v^b.
Fitted fit_power(Route route, const std::vector<Run>& runs, const FitOptions& options) {
  if (options.fixed[0] && !(*options.fixed[0] > 0))
    fail("a = {} cannot be fixed: it must be positive", *options.fixed[0]);
  std::vector<Response> responses = responses_of(runs);
  const bool known = !responses.empty();
  if (options.fit_slope && route == Route::loglog)
    fail("a line through ln D does not show the slope: take the route shift");
  if (options.fit_slope && route == Route::shift && !known)
    fail("D alone does not show the slope: `##` lines must say how D was made");
  if ((options.fit_wind || runs.front().body.wind != 0) && !is_trajectory(route))
    fail("D alone does not show the wind: take the route velocity or position");
  if (options.robust && known)
    fail(
        "a robust fit judges single readings, and a filter spreads an outlier over many: fit the "
        "column that was not smoothed");
  if (route == Route::loglog) return fit_log_log(runs, options, std::move(responses));
  if (!known && route == Route::shift) return fit_shift(runs, options);
  Fitted fit = fit_rolls(route, runs, usable(route, runs), std::move(responses), options);
  if (route == Route::velocity && !known && !options.robust && !options.possible_filters.empty() &&
      fit.minimum.f.size() >= levels::least_tested)
    if (auto differences = fit_differences(runs, options, fit)) return *std::move(differences);
  return fit;
}

}  // namespace

Fitted fit_route(Route route, const std::vector<Run>& runs, const FitOptions& options) {
  if (options.fits_power()) return fit_power(route, runs, options);
  if (route == Route::loglog)
    fail("a straight line of logarithms is a law a v^b: fit D = {} on the route shift",
         options.law->formula);
  if (options.robust) fail("D = {} is fitted by squares only, not robustly", options.law->formula);
  FitOptions of_power = options;
  of_power.fixed = {};
  const Fitted power = fit_power(route, runs, of_power);
  Fitted found = fit_beside(power, *options.law, options.fixed);
  if (was_found(found)) {
    const std::size_t rows = found.minimum.f.size();
    const Parameters& q = found.parameters();
    require_rows(rows, is_trajectory(route) || q.shared() > 0 ? q.count() : 0, rows);
  }
  const char* const formula = options.law->formula;
  if (!was_found(found) && found.parameters().scene() == 0)
    fail<MotionError>("the rows do not determine D = {}", formula);
  if (!was_found(found))
    fail<OneWay>("the rows do not determine D = {} and the {}", formula,
                 power.scene.empty() ? "wind" : "slope of the mat");
  return found;
}

}  // namespace rolling
