#include "fit/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "fit/eccentricity.h"
#include "fit/agreement.h"
#include "base/by_run.h"
#include "base/dot.h"
#include "fit/errors.h"
#include "fit/first_guess.h"
#include "fit/log_log_regression.h"
#include "fit/model_shift.h"
#include "fit/sensor_filters.h"

namespace rolling {

void require_records(std::size_t n, std::size_t p) {
  if (n == 0) fail("no record can be fitted");
  if (p == 0) fail("a and b are both held: nothing is left to fit");
  if (n < p) fail("{} record{} cannot determine {} parameters", n, n == 1 ? "" : "s", p);
}

Minimum solve(const System& system, const std::vector<double>& start, const FitOptions& options) {
  return options.robust ? minimise_robust(system, start) : minimise(system, start);
}

namespace {

/// The runs without filters, for a first guess: positions for the position route, speeds for the
/// velocity and shift routes.
std::vector<ObservedRun> without_filters(Route route, std::vector<ObservedRun> runs,
                                         const std::vector<FitRun>& all,
                                         const std::vector<Rows>& rows) {
  const bool position = route == Route::position;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    ObservedRun& run = runs[r];
    run.H.reset();
    run.raw_is_position = position;
    run.t.clear();
    run.y.clear();
    for (std::size_t i : rows[r]) {
      run.t.push_back(all[r].t[i] - run.origin);
      run.y.push_back(position ? all[r].x[i] : all[r].v[i]);
    }
  }
  return runs;
}

/// Removes from `rows` the records whose fitted speed is below the limit; returns whether there
/// were any. The fitted speed decides, because a threshold on noisy speeds would select records by
/// their noise.
bool leave_out_slow(const RollModel& model, const std::vector<double>& theta,
                    const std::vector<FitRun>& all, std::vector<Rows>& rows, double limit) {
  std::size_t slow = 0;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const Trajectory fitted = model.trajectory(theta, r);
    slow += std::erase_if(rows[r], [&](std::size_t i) {
      return fitted.speed_at(all[r].t[i] - model.runs()[r].origin).v < limit;
    });
  }
  return slow > 0;
}

/// The sum of squares of the unweighted residuals, in the unit of the fitted column.
double squares_of(const Fitted& fit) {
  if (!fit.noise->known()) return fit.minimum.rss;
  double sum = 0;
  const auto plain = fit.noise->without_weights(fit.minimum.f);
  const auto f_of = by_run(plain, fit.system.runs);
  for (std::size_t r = 0; r < f_of.size(); ++r) {
    const ObservedRun& run = fit.rolls->runs()[r];
    sum += dot(f_of[r].first(run.records()), f_of[r]) * run.unit * run.unit;
  }
  return sum;
}

/// Writes a, b, the slope and v0 with their gradients, the number of records and their sum of
/// squares into the fit.
void report(Fitted& fit) {
  const std::vector<double>& theta = fit.minimum.theta;
  const Parameters& q = fit.rolls->parameters();
  const PowerLaw law = q.law(theta);
  const auto quantity = [&](double value, const Parameters::Derivatives& by) {
    Quantity result{value, std::vector<double>(q.columns())};
    q.chain(result.gradient.data(), 1, law.a, by);
    return result;
  };
  fit.a = quantity(law.a, {1, 0});
  fit.b = quantity(law.b, {0, 1});
  if (q.fits_slope()) fit.slope = quantity(q.slope(theta, 0), {0, 0, 0, 0, 1});
  const auto& runs = fit.rolls->runs();
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const double way = runs[r].way;
    const auto s = fit.rolls->trajectory(theta, r).speed_at(runs[r].start);
    fit.v0.push_back(quantity(way * s.v, {way * s.v_a, way * s.v_b, way * s.v_v0, 0, s.v_S}));
    fit.records += runs[r].records();
  }
  fit.rss = squares_of(fit);
}

/// The minimum over these runs with these weights; the results are not yet reported.
Fitted minimum_of(std::vector<ObservedRun> runs, const FirstGuess& start, const FitOptions& options,
                  double share, bool inferred) {
  auto noise = noise_of(runs, share, inferred);
  auto rolls = std::make_shared<const RollModel>(std::move(runs), start.parameters);
  System system = system_of(rolls, noise);
  Minimum minimum = solve(system, start.theta, options);
  return {.system = std::move(system),
          .minimum = std::move(minimum),
          .noise = std::move(noise),
          .rolls = std::move(rolls)};
}

/// True if the weighted sum of squares is more than four times what the unweighted residuals and
/// the filters predict, that is, if the columns hold noise that did not pass the filters.
bool rounded(const Fitted& fit) {
  if (!fit.filters_known()) return false;
  double norms = 0;
  const auto plain = fit.noise->without_weights(fit.minimum.f);
  for (const ObservedRun& run : fit.rolls->runs())
    for (const double norm : row_norms(*run.H)) norms += norm * norm;
  return fit.minimum.rss * norms > 4 * dot(plain, plain) * static_cast<double>(plain.size());
}

/// Columns that were rounded after a filter hold additional white noise. Its share is estimated by
/// restricted likelihood, and the fit is repeated with the new weights.
void allow_for_rounding(Fitted& fit, const FitOptions& options) {
  if (!rounded(fit)) return;
  fit.system = {}, fit.noise = {};  // frees memory: these are large, and the search needs as much
  const WhiteShare found =
      most_likely_share(fit.rolls, fit.minimum.theta, floor_share, 1, floor_share);
  fit.noise = noise_of(fit.rolls->runs(), found.decisive() ? found.share : floor_share, false);
  fit.system = system_of(fit.rolls, fit.noise);
  if (found.decisive()) fit.minimum = solve(fit.system, fit.minimum.theta, options);
}

}  // namespace

Fitted fit_of_run(const Fitted& joint, std::size_t r, const FitOptions& options) {
  const auto& theta = joint.minimum.theta;
  const Parameters& all = joint.rolls->parameters();
  ObservedRun run = joint.rolls->runs()[r];
  run.body.slope = all.slope(theta, run.body.slope);
  Fitted fit = minimum_of({std::move(run)}, {all.of_one_run(), all.theta_of_run(theta, r)}, options,
                          joint.noise->share(), joint.noise->inferred());
  report(fit);
  return fit;
}

Fitted fit_rolls(Route route, const std::vector<FitRun>& all, std::vector<Rows> rows,
                 std::vector<Response> responses, const FitOptions& options,
                 std::optional<double> inferred_share) {
  std::optional<FirstGuess> guess;
  Fitted fit{};
  for (int round = 0; round < 4; ++round) {  // each round removes the slow records of the last fit
    auto runs = observe(route, all, rows, responses, options);
    if (!guess) {
      std::size_t n = 0;
      for (const ObservedRun& run : runs) n += run.y.size();
      require_records(n, Parameters(options, route == Route::position, runs.size(), 1, 1).count());
      guess = responses.empty() ? first_guess(runs, options)
                                : first_guess(without_filters(route, runs, all, rows), options);
    }
    if (options.min_speed <= 0) responses = {}, rows.clear();  // frees memory: no round follows
    fit = {};                                                  // frees memory
    fit = minimum_of(std::move(runs), *guess, options, inferred_share.value_or(floor_share),
                     inferred_share.has_value());
    guess->theta = fit.minimum.theta;
    if (options.min_speed <= 0 ||
        !leave_out_slow(*fit.rolls, guess->theta, all, rows, options.min_speed))
      break;
  }
  allow_for_rounding(fit, options);
  report(fit);
  for (const Rows& of_run : usable(route, all)) fit.left_out += of_run.size();
  fit.left_out -= fit.records;
  return fit;
}

std::vector<Rows> usable(Route route, const std::vector<FitRun>& all) {
  std::vector<Rows> rows;
  for (const FitRun& run : all) {
    const auto& y = route == Route::position ? run.x : run.v;
    Rows& of_run = rows.emplace_back();
    of_run.reserve(y.size());
    for (std::size_t i = 0; i < y.size(); ++i)
      if (std::isfinite(y[i]) && (route != Route::shift || std::isfinite(run.D[i])))
        of_run.push_back(i);
  }
  return rows;
}

Fitted fit_route(Route route, const std::vector<FitRun>& runs, const FitOptions& options) {
  if (options.a && !(*options.a > 0))
    fail("a = {} cannot be held: it must be positive", *options.a);
  std::vector<Response> responses = responses_of(route, runs);
  const bool known = !responses.empty();
  if (options.fit_slope && (route == Route::loglog || (route == Route::shift && !known)))
    fail("the slope shows in a roll alone: on this route `##` lines must tell how D was made");
  if (options.robust && known)
    fail(
        "robust fits judge single records, but filters have spread each outlier over many: fit the "
        "raw column");
  if (route == Route::loglog) return fit_log_log(runs, options, std::move(responses));
  if (!known && route == Route::shift) return fit_shift(runs, options);
  Fitted fit = fit_rolls(route, runs, usable(route, runs), std::move(responses), options);
  if (route == Route::velocity && !known && !options.robust && !options.possible_filters.empty() &&
      fit.minimum.f.size() >= 30)
    if (auto differences = fit_differences(runs, options, fit)) return *std::move(differences);
  return fit;
}

namespace {

/// The result, with standard errors that combine the contributions.
FitResult result_of(const Fitted& found, const NoiseErrors& noise, std::vector<ErrorShare> shares) {
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
                   .rms = std::numeric_limits<double>::quiet_NaN(),
                   .n = found.records,
                   .left_out = found.left_out,
                   .whiteness = noise.whiteness,
                   .v0 = {},
                   .sigma_v0 = {},
                   .errors = noise.kind};
  const std::size_t n = found.minimum.f.size(), p = found.minimum.theta.size();
  if (n > p) result.rms = std::sqrt(found.rss / static_cast<double>(n - p));
  double together = 0;
  for (const ErrorShare& share : shares) together += share.together;
  if (together != 0) result.corr = together / (result.sigma_a * result.sigma_b);
  for (std::size_t r = 0; r < found.v0.size(); ++r) {
    result.v0.push_back(found.v0[r].value);
    result.sigma_v0.push_back(total([r](const ErrorShare& of) { return of.v0[r]; }));
  }
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
      if (!std::isfinite(x)) fail("the fit gives no finite errors of a and b");
  // Large errors of a nonlinear fit are not reliable themselves; hence these limits on them.
  if (options.fit_slope && (!(result.sigma_a < result.a / 10) || !(result.sigma_b < 0.1)))
    fail(
        "a slope of the mat and its law slow the body down alike, and these runs do not tell them "
        "apart (a comes out as {:.3g} +- {:.2g}): add runs in the other direction",
        result.a, result.sigma_a);
  if (result.sigma_b > 3)
    fail("the data do not determine b: it comes out as {:.3g} +- {:.2g}", result.b, result.sigma_b);
  if (result.errors == Errors::none && !options.b && std::abs(result.b) > 10)
    fail("as many parameters as records do not determine b: it comes out as {:.3g}", result.b);
}

FitResult fit_from_start(Route route, const std::vector<FitRun>& runs, const FitOptions& options) {
  Fitted found = fit_route(route, runs, options);
  const Uncertainty uncertainty = uncertainty_of(found);
  NoiseErrors noise = noise_errors(found, uncertainty);
  const auto eccentricity = eccentricity_of(route, runs, found, uncertainty.variance);
  const auto agreement = agreement_of(route, runs, options, noise, found);
  std::vector<ErrorShare> shares{noise.share};
  require_determined(result_of(found, noise, shares), options);
  for (ErrorShare& share : shares_of_given(route, runs, options, found))
    shares.push_back(std::move(share));
  if (found.bias_a != 0 || found.bias_b != 0)
    shares.push_back(
        {"bias", std::abs(found.bias_a), std::abs(found.bias_b), found.bias_a * found.bias_b});
  FitResult result = result_of(found, noise, std::move(shares));
  if (!is_trajectory(route)) result.v0 = result.sigma_v0 = {};
  result.agreement = agreement;
  result.eccentricity = eccentricity;
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
