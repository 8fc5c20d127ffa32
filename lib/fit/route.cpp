// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/route.h"

#include "base/error.h"
#include "fit/laws.h"
#include "fit/roll_fit.h"
#include "fit/sensor_filters.h"
#include "fit/shift_rows.h"

namespace rolling {

namespace {

/// Fits a v^b.
Fitted fit_power(Route route, const std::vector<FitRun>& runs, const FitOptions& options) {
  if (options.a && !(*options.a > 0))
    fail("a = {} cannot be fixed: it must be positive", *options.a);
  std::vector<Response> responses = responses_of(route, runs);
  const bool known = !responses.empty();
  if (options.fit_slope && route == Route::loglog)
    fail("the slope shows in a roll alone, not in a line through ln D: --route shift");
  if (options.fit_slope && route == Route::shift && !known)
    fail("the slope shows in a roll alone: on this route `##` lines must tell how D was made");
  if (options.robust && known)
    fail(
        "--robust judges single readings, and a filter spreads an outlier over many: fit the "
        "column "
        "that was not smoothed");
  if (route == Route::loglog) return fit_log_log(runs, options, std::move(responses));
  if (!known && route == Route::shift) return fit_shift(runs, options);
  Fitted fit = fit_rolls(route, runs, usable(route, runs), std::move(responses), options);
  if (route == Route::velocity && !known && !options.robust && !options.possible_filters.empty() &&
      fit.minimum.f.size() >= 30)
    if (auto differences = fit_differences(runs, options, fit)) return *std::move(differences);
  return fit;
}

}  // namespace

Fitted fit_route(Route route, const std::vector<FitRun>& runs, const FitOptions& options) {
  if (options.fits_power()) return fit_power(route, runs, options);
  if (route == Route::loglog)
    fail("a straight line of logarithms is a law a v^b: fit D = {} with --route shift",
         options.law->formula);
  if (options.robust)
    fail("D = {} is fitted by squares only, not with --robust", options.law->formula);
  if (options.a || options.b || options.start_a || options.start_b)
    fail("a and b are fixed, or have a start, in a law a v^b alone, not in D = {}",
         options.law->formula);
  return fit_of_law(fit_power(route, runs, options), *options.law);
}

}  // namespace rolling
