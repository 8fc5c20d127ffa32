// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/fit.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/enumeration.h"
#include "base/error.h"
#include "base/grid.h"
#include "fit/diagnostics.h"
#include "fit/refits.h"
#include "fit/fitted.h"
#include "fit/routes.h"
#include "statistics/residuals.h"

namespace rolling {

namespace {

/// The result, with standard errors that combine the contributions.
FitResult result_of(const Fitted& found, double rms, const Uncertainty& noise,
                    std::vector<ErrorShare> shares) {
  FitResult result{.law = found.law(),
                   .rms = rms,
                   .n = found.minimum.f.size(),
                   .freedom = found.degrees_left(),
                   .negative = found.negative,
                   .whiteness = noise.whiteness,
                   .errors = noise.kind};
  Matrix covariance(noise.covariance.size(), std::vector<double>(noise.covariance.size(), 0));
  for (const ErrorShare& share : shares)
    for (std::size_t i = 0; i < covariance.size(); ++i)
      for (std::size_t j = 0; j < covariance.size(); ++j)
        covariance[i][j] += share.covariance[i][j];
  std::size_t number = 0;
  const auto next = [&](double value) {
    const double variance = covariance[number][number];
    ++number;
    return Estimate{value, std::sqrt(variance)};
  };
  for (const FittedNumber& c : found.coefficients) result.coefficients.push_back(next(c.value));
  result.correlations = correlations_of(covariance, result.law.size());
  if (result.law.power()) {
    const auto& [a, b] = std::tie(result.coefficients[0], result.coefficients[1]);
    result.a = a.value;
    result.sigma_a = a.sigma;
    result.b = b.value;
    result.sigma_b = b.sigma;
    result.corr = result.correlations[0][1];
  }
  auto of_scene = found.scene.begin();
  for (std::size_t i = 0; i < scene_numbers.size(); ++i)
    if (found.parameters().fits(i)) result.scene[i] = next((of_scene++)->value);
  for (const FittedNumber& v0 : found.v0)
    result.v0.push_back(result.v0.empty() ? next(v0.value) : Estimate{v0.value});
  for (const FittedNumber& x0 : found.x0)
    result.x0.push_back(number < covariance.size() ? next(x0.value) : Estimate{x0.value});
  result.shares = std::move(shares);
  return result;
}

/// "a and b", "d0, a and b": the coefficients of a law.
std::string names_of(const LawForm& form) {
  std::vector<std::string> all;
  for (const auto& c : form.coefficients) all.push_back(c.name);
  return enumeration(all);
}

/// True if the rolls together go up the slope and down.
bool both_ways(const Fitted& found) {
  const auto& runs = found.model.runs();
  for (std::size_t r = 0; r < runs.size(); ++r) {
    Roll roll = found.roll(r);
    const double last = runs[r].t.back();
    if (runs[r].way != runs[0].way || (roll.stop_until(last) < last && roll.turns())) return true;
  }
  return false;
}

/// False for an exponent whose error is no knowledge of a mat; without errors, for one that no mat
/// has.
bool is_known(const FitResult& result, std::size_t j, const FitOptions& options) {
  const LawForm::Coefficient& c = result.law.form().coefficients[j];
  const bool is_exponent = c.D == 0 && c.v == 0;
  const auto& [value, sigma] = result.coefficients[j];
  if (!is_exponent) return true;
  if (result.errors == Errors::none) return options.fixed[j] || std::abs(value) <= 10;
  return sigma <= levels::largest_sigma_b;
}

bool all_known(const FitResult& result, const FitOptions& options) {
  for (std::size_t j = 0; j < result.coefficients.size(); ++j)
    if (!is_known(result, j, options)) return false;
  return true;
}

/// Throws Error if the data do not determine the law or the slope of the mat. A slope slows the
/// body down as the law does: runs in both directions separate them, or a law a v^b that is well
/// known, but never a constant d0.
void require_determined(const FitResult& result, const FitOptions& options, const Fitted& found,
                        bool agree) {
  const auto not_visited = [&](std::size_t number) {
    const auto at = std::ranges::find(result.not_visited, number, &Interval::number);
    return at == result.not_visited.end() ? nullptr : &*at;
  };
  const LawForm& form = result.law.form();
  const bool has_errors = result.errors != Errors::none;
  double all = has_errors ? result.rms : 0;
  for (const Estimate& c : result.coefficients) all += c.value + (has_errors ? c.sigma : 0);
  for (const std::vector<double>& row : result.correlations)
    for (const double correlation : row) all += has_errors ? correlation : 0;
  if (!std::isfinite(all))
    fail<NotOneRoll>("the fit gives no finite {}, or no finite errors", names_of(form));
  const auto shown = [&](const Estimate& c) {
    return fmt::format("{:.3g}{}", c.value, has_errors ? fmt::format(" +- {:.3g}", c.sigma) : "");
  };
  if (options.fit_wind && !both_ways(found) && (!has_errors || !result.not_visited.empty()))
    fail<OneWay>("a wind and the law slow the body down alike, and these runs go one way");
  if (options.fit_slope && !both_ways(found) &&
      !(agree && has_errors && result.law.power() && all_known(result, options) &&
        !not_visited(0) && !not_visited(form.coefficients.size())))
    refuse_one_way(fmt::format(" ({} comes out as {})", form.coefficients.front().name,
                               shown(result.coefficients.front())));
  for (std::size_t j = form.coefficients.size(); j-- > 0;) {  // an exponent comes last
    bool known = is_known(result, j, options);
    if (const Interval* profile = not_visited(j))
      known = known && (std::isfinite(profile->lower) || std::isfinite(profile->upper));
    if (!known)
      fail<LooseExponent>("the data do not determine {}, which comes out as {}",
                          form.coefficients[j].name, shown(result.coefficients[j]));
  }
}

/// Throws Error if the roll has no shift, as a body at rest; if it has lost nearly all of v0 before
/// the second reading, as where the first one is wrong; or if rows follow after D has reached R
/// (exact geometry, b < 0) at a speed that is not next to rest. There the model lets D be R, which
/// serves the search, but is not the law.
void require_roll(const Fitted& found) {
  if (!found.is_roll()) return;
  constexpr double rest = 1e-3;  // of v0; below it MemoryRoll, too, counts a body as at rest
  const auto& runs = found.model.runs();
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const ObservedRun& run = runs[r];
    Roll roll = found.roll(r);
    const double v0 = std::abs(found.v0[r].value);
    const double D = found.law().at(v0).D;
    const double last = run.t.back();
    if (run.body.slope == 0 && found.scene.empty() && std::abs(D) < program_rounding * run.body.R)
      fail("{}the body does not slow down: D comes out as {:.2g} m", run.place, D);
    double fastest = 0;
    for (std::size_t i = 0; i + 1 < run.t.size() && fastest <= v0 / levels::v0_over_speeds; ++i)
      fastest = std::max(fastest, std::abs(roll.at(run.t[i + 1]).x - roll.at(run.t[i]).x) /
                                      (run.t[i + 1] - run.t[i]));
    const bool too_fast = v0 > levels::v0_over_speeds * fastest;
    if (too_fast && found.parameters().fixes_v0())
      fail("{}no reading comes near the fixed v0, {:.3g} m/s", run.place, found.v0[r].value);
    if (too_fast)
      fail<ReadingOff>(
          "{}no reading comes near v0 = {:.3g} m/s: the first one, at t = {} s, does not belong to "
          "the roll, or too few do",
          run.place, found.v0[r].value, run.origin);
    if (roll.radius_time(last) < last && roll.radius_speed() > rest * v0)
      fail(
          "{}below {:.2g} m/s D is beyond the radius {} m, and {} have no meaning: leave out the "
          "rows that follow, or fit with A = 1",
          run.place, roll.radius_speed(), run.body.R, names_of(found.parameters().form()));
  }
}

/// How far v0 [m/s] of the first run may be off if a filter correlates the noise of the speeds, as
/// y_i = AR y_(i-1) + (1 - AR) v_i, which delays them by AR/(1 - AR) rows. A mean of so many rows
/// delays them by half of that, or not at all. A run does not show a delay of more than a tenth of
/// itself: in few rows AR may come out as anything.
double error_of_delay(const Fitted& found) {
  const double AR = autoregression(found.minimum.f, found.minimum.theta.size(), found.model.rows());
  const std::vector<double>& t = found.model.runs().front().t;
  const double step = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  const double rows = std::min(std::max(AR, 0.0) / (1 - AR), static_cast<double>(t.size()) / 10);
  const double delay = rows * step;
  return std::abs(delay * found.roll(0).at(0).a);
}

FitResult fit_from_start(Route route, const std::vector<Run>& runs, const FitOptions& options) {
  Fitted found = fit_route(route, runs, options);
  Matrix Q = orthonormal(found.system(), found.minimum);
  const auto eccentricity = eccentricity_of(found, Q);
  const auto clock_jump = jump_of_clock(found, Q);
  Uncertainty noise = uncertainty_of(found, std::move(Q));
  const auto agreement = agreement_of(route, runs, options, noise, found);
  if (route == Route::velocity && noise.kind == Errors::autocorrelation && !found.noise().known())
    found.error_of_clock = error_of_delay(found);
  std::vector<ErrorShare> shares{{"noise", noise.covariance}};
  const auto freedom = static_cast<double>(found.minimum.f.size() - found.minimum.theta.size());
  const double rms = found.degrees_left() == 0 ? NAN : std::sqrt(sum_of_squares(found) / freedom);
  require_roll(found);
  FitResult of_noise = result_of(found, rms, noise, shares);
  std::vector<Interval>& not_visited = of_noise.not_visited;
  const bool agree = !agreement || agreement->agree();
  const bool of_minimum = !options.robust && agree;
  if (of_minimum && noise.kind != Errors::none && all_known(of_noise, options))
    not_visited = intervals_not_visited(found, noise, options);
  require_determined(of_noise, options, found, agree);
  for (ErrorShare& share : shares_of_inputs(route, runs, options, found, agree))
    shares.push_back(std::move(share));
  if (!found.bias.empty()) shares.push_back({"bias", outer_square(found.bias)});
  if (found.error_of_clock > 0) {
    std::vector<double> of_v0(found.numbers().size());
    of_v0[found.coefficients.size() + found.scene.size()] = found.error_of_clock;
    shares.push_back({"clock", outer_square(of_v0)});
  }
  FitResult result = result_of(found, rms, noise, std::move(shares));
  if (!is_trajectory(route)) result.v0 = {};
  for (const Rows& readings : usable(route, runs)) result.left_out += readings.size();
  result.left_out -= result.n;
  result.agreement = agreement;
  result.eccentricity = eccentricity;
  if (!options.robust) result.off = off_readings(found, false);  // else they count little
  result.clock_jump = clock_jump;
  if (noise.kind == Errors::uneven) result.clock_noise = noise_of_clock(found);
  result.not_visited = std::move(not_visited);
  if (!options.robust) result.reversals = few_reversals(found);
  return result;
}

/// The readings that are off the robust roll; none where there is no robust roll either.
OffReadings off_robust_roll(Route route, const std::vector<Run>& runs, FitOptions options) try {
  options.robust = true;
  return off_readings(fit_route(route, runs, options), true);
} catch (const Error&) {
  return {};
}

}  // namespace

FitResult fit(Route route, const std::vector<Run>& runs, const FitOptions& options) {
  constexpr std::size_t single = 3;
  try {
    return fit_from_start(route, runs, options);
  } catch (const Error&) {  // of the data, or of single readings
    const auto is_long = [](const Run& run) { return run.t.size() > long_run; };
    if (options.robust || std::ranges::any_of(runs, is_long)) throw;
    const OffReadings off = off_robust_roll(route, runs, options);
    if (off.count == 0 || off.count > single) throw;
    fail<ReadingOff>(
        "{}the reading at t = {:.12g} s is {:.2g} standard deviations off the roll of the others",
        runs.size() > 1 ? fmt::format("run {}: ", runs[off.run].name) : "", off.time, off.distance);
  }
}

}  // namespace rolling
