// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/fit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/error.h"
#include "base/rounding.h"
#include "fit/agreement.h"
#include "fit/eccentricity.h"
#include "fit/errors.h"
#include "fit/input_quantities.h"
#include "fit/off_readings.h"
#include "fit/roll_fit.h"
#include "fit/route.h"

namespace rolling {

namespace {

/// sqrt(RSS / (n - p)); NaN where no degree of freedom is left for the noise.
double rms_of(const Fitted& found) {
  const std::size_t n = found.minimum.f.size(), p = found.minimum.theta.size();
  if (found.degrees_left() == 0) return std::numeric_limits<double>::quiet_NaN();
  return std::sqrt(sum_of_squares(found) / static_cast<double>(n - p));
}

/// The result, with standard errors that combine the contributions.
FitResult result_of(const Fitted& found, double rms, const NoiseErrors& noise,
                    std::vector<ErrorShare> shares) {
  const auto total = [&](auto&& part) {
    double square = 0;
    for (const ErrorShare& share : shares) square += part(share) * part(share);
    return std::sqrt(square);
  };
  FitResult result{.a = found.a.value,
                   .sigma_a = total([](const ErrorShare& of) { return of.a; }),
                   .b = found.b.value,
                   .sigma_b = total([](const ErrorShare& of) { return of.b; }),
                   .corr = 0,
                   .rms = rms,
                   .n = found.rows,
                   .left_out = found.left_out,
                   .negative = found.negative,
                   .whiteness = noise.whiteness,
                   .errors = noise.kind};
  double together = 0;
  for (const ErrorShare& share : shares) together += share.together;
  if (together != 0) result.corr = together / (result.sigma_a * result.sigma_b);
  for (std::size_t r = 0; r < found.v0.size(); ++r)
    result.v0.push_back({found.v0[r].value, total([r](const ErrorShare& of) { return of.v0[r]; })});
  for (std::size_t r = 0; r < found.x0.size(); ++r)
    result.x0.push_back({found.x0[r].value, total([r](const ErrorShare& of) { return of.x0[r]; })});
  if (found.slope) {
    result.slope = found.slope->value;
    result.sigma_slope = total([](const ErrorShare& of) { return of.slope; });
  }
  result.shares = std::move(shares);
  return result;
}

/// Throws Error if the data do not determine a, b or the slope.
void require_determined(const FitResult& result, const FitOptions& options) {
  for (double x : {result.a, result.b})
    if (!std::isfinite(x)) fail("the fit gives no finite a and b");
  if (result.errors != Errors::none)
    for (double x : {result.sigma_a, result.sigma_b, result.corr, result.rms})
      if (!std::isfinite(x)) fail("the fit gives no finite errors of a and b: {}", choose_the_roll);
  // Large errors of a nonlinear fit are not reliable themselves; hence these limits on them.
  const auto backwards = [](const Estimate& v0) { return v0.value < 0; };
  const bool one_way = std::ranges::adjacent_find(result.v0, std::ranges::not_equal_to(),
                                                  backwards) == result.v0.end();
  if (options.fit_slope && one_way &&
      (!(result.sigma_a < result.a / 10) || !(result.sigma_b < 0.1)))
    fail(
        "a slope of the mat and its law slow the body down alike, and these runs do not tell them "
        "apart (a comes out as {:.3g}{}): add runs in the other direction",
        result.a, result.errors == Errors::none ? "" : fmt::format(" +- {:.2g}", result.sigma_a));
  if (result.errors != Errors::none && !determines_b(result.sigma_b))
    fail(
        "the data do not determine b, which comes out as {:.3g} +- {:.3g}: {}; or fix it, --fix "
        "b=0",
        result.b, result.sigma_b, choose_the_roll);
  if (result.errors == Errors::none && !options.b && std::abs(result.b) > 10)
    fail("as many parameters as rows do not determine b: it comes out as {:.3g}", result.b);
}

/// Throws Error if the roll has no shift, as a body at rest, or if it has lost nearly all of v0
/// before the second reading, as where the first one is wrong.
void require_seen(const Fitted& found, const std::vector<FitRun>& all) {
  if (!found.rolls) return;
  const auto& runs = found.rolls->runs();
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const ObservedRun& run = runs[r];
    const std::string place = runs.size() > 1 ? fmt::format("run {}: ", all[r].name) : "";
    Roll roll = found.rolls->roll(found.minimum.theta, r);
    const double v0 = std::abs(found.v0[r].value), D = found.a.value * std::pow(v0, found.b.value);
    if (run.body.slope == 0 && !found.slope && std::abs(D) < program_rounding * run.body.R)
      fail("{}the body does not slow down: D comes out as {:.2g} m", place, D);
    double fastest = 0;
    for (std::size_t i = 0; i + 1 < run.t.size() && fastest <= v0 / levels::v0_over_speeds; ++i)
      fastest = std::max(
          fastest, (roll.at(run.t[i + 1]).x - roll.at(run.t[i]).x) / (run.t[i + 1] - run.t[i]));
    if (v0 > levels::v0_over_speeds * fastest)
      fail(
          "{}no reading comes near v0 = {:.3g} m/s: is the first one, at t = {} s, of the roll? "
          "Leave it out (smooth --outliers or --from), or fit with --robust",
          place, found.v0[r].value, run.origin);
  }
}

/// Throws Error if rows follow after D has reached R (exact geometry, b < 0) at a speed that is
/// not next to rest. There the model lets D be R, which serves the search, but is not the law.
void require_law(const Fitted& found, const std::vector<FitRun>& all) {
  if (!found.rolls) return;
  constexpr double rest = 1e-3;  // of v0; below it MemoryRoll, too, counts a body as at rest
  const auto& runs = found.rolls->runs();
  for (std::size_t r = 0; r < runs.size(); ++r) {
    Roll roll = found.rolls->roll(found.minimum.theta, r);
    const double last = runs[r].t.back();
    if (roll.radius_time(last) < last && roll.radius_speed() > rest * std::abs(found.v0[r].value))
      fail(
          "{}a = {:.4g} and b = {:.4g} have no meaning below {:.2g} m/s, where D is beyond the "
          "radius {} m: leave the rows out that follow, or fit with A = 1",
          runs.size() > 1 ? fmt::format("run {}: ", all[r].name) : "", found.a.value, found.b.value,
          roll.radius_speed(), runs[r].body.R);
  }
}

FitResult fit_from_start(Route route, const std::vector<FitRun>& runs, const FitOptions& options) {
  Fitted found = fit_route(route, runs, options);
  const Uncertainty uncertainty = uncertainty_of(found);
  NoiseErrors noise = noise_errors(found, uncertainty);
  const auto eccentricity = eccentricity_of(route, runs, found, uncertainty.variance);
  const auto off = off_readings(route, runs, options, found);
  const auto agreement = agreement_of(route, runs, options, noise, found);
  std::vector<ErrorShare> shares{noise.share};
  const double rms = rms_of(found);
  require_seen(found, runs);
  require_determined(result_of(found, rms, noise, shares), options);
  require_law(found, runs);
  for (ErrorShare& share :
       shares_of_given(route, runs, options, found, !agreement || agreement->agree()))
    shares.push_back(std::move(share));
  if (found.bias_a != 0 || found.bias_b != 0)
    shares.push_back(
        {"bias", std::abs(found.bias_a), std::abs(found.bias_b), found.bias_a * found.bias_b});
  FitResult result = result_of(found, rms, noise, std::move(shares));
  if (!is_trajectory(route)) result.v0 = {};
  result.agreement = agreement;
  result.eccentricity = eccentricity;
  result.off = off;
  return result;
}

}  // namespace

FitResult fit(Route route, const std::vector<FitRun>& runs, const FitOptions& options) {
  if (!options.start_a && !options.start_b) return fit_from_start(route, runs, options);
  try {
    return fit_from_start(route, runs, options);
  } catch (const Error&) {  // of the data, or of the start alone
    FitOptions free = options;
    free.start_a = free.start_b = {};
    fit_from_start(route, runs, free);
    fail("the search does not find the fit from the start that is given, but it does without it");
  }
}

}  // namespace rolling
