#include "fit/fit.h"

#include "base/error.h"
#include "fit/routes.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace rolling {
namespace {

double sum_of_squares(const std::vector<double>& f) {
  return std::inner_product(f.begin(), f.end(), f.begin(), 0.0);
}

bool taken_as_white(const RouteFit& r) { return r.minimum.f.size() < 30 || !(r.whiteness <= 0.01); }

FitResult conclude(const RouteFit& r) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t n = r.minimum.f.size(), p = r.minimum.theta.size(), q = r.a.gradient.size();
  FitResult result{.a = r.a.value,
                   .sigma_a = nan,
                   .b = r.b.value,
                   .sigma_b = nan,
                   .corr = 0,
                   .rms = nan,
                   .n = n,
                   .left_out = r.left_out,
                   .whiteness = nan,
                   .v0 = {},
                   .sigma_v0 = {},
                   .x0 = {},
                   .sigma_x0 = {},
                   .errors = Errors::none};
  std::vector<double> middle(r.minimum.R.size(), nan);
  if (n > p) {
    result.rms = std::sqrt((r.plain.empty() ? r.minimum.rss : sum_of_squares(r.plain)) /
                           static_cast<double>(n - p));
    result.whiteness = r.whiteness;
    const bool white = taken_as_white(r);
    if (white && !r.noise.empty() && !r.judged) {
      middle = r.noise.middle(r.minimum.f, r.Q, r.shared);
      result.errors = Errors::filters;
    } else if (white) {
      for (std::size_t i = 0; i < middle.size(); ++i)
        middle[i] = i % (q * q) % (q + 1) ? 0 : r.minimum.rss / static_cast<double>(n - p);
      result.errors = r.judged ? Errors::differences : Errors::classical;
    } else {
      std::vector<double> scores = r.Q;
      for (std::size_t i = 0; i < scores.size(); ++i) scores[i] *= r.minimum.f[i / q];
      middle = newey_west(scores, p, r.minimum.f, r.runs);
      add_shared(middle, q, r.shared);
      for (double& x : middle) x *= static_cast<double>(n) / static_cast<double>(n - p);
      result.errors = Errors::autocorrelation;
    }
  }
  const Spread covariance(r.minimum.R, middle, q);
  const auto fixed = [](const Quantity& x) { return sum_of_squares(x.gradient) == 0; };
  const auto sigma = [&](const Quantity& x, std::size_t run = 0) {
    return fixed(x) ? 0 : std::sqrt(covariance(x.gradient, x.gradient, run));
  };
  result.sigma_a = sigma(r.a);
  result.sigma_b = sigma(r.b);
  if (!fixed(r.a) && !fixed(r.b) && result.sigma_a != 0 && result.sigma_b != 0)
    result.corr = covariance(r.a.gradient, r.b.gradient) / (result.sigma_a * result.sigma_b);
  for (const auto& v0 : r.v0)
    result.v0.push_back(v0.value), result.sigma_v0.push_back(sigma(v0, result.sigma_v0.size()));
  for (const auto& x0 : r.x0)
    result.x0.push_back(x0.value), result.sigma_x0.push_back(sigma(x0, result.sigma_x0.size()));
  for (double x : {result.a, result.b})
    if (!std::isfinite(x)) fail("the fit gives no finite a and b");
  if (result.errors != Errors::none)
    for (double x : {result.sigma_a, result.sigma_b, result.corr, result.rms})
      if (!std::isfinite(x)) fail("the fit gives no finite errors of a and b");
  if (result.sigma_b > 3)
    fail("the data do not determine b: it comes out as {:.3g} +- {:.2g}", result.b, result.sigma_b);
  return result;
}

}  // namespace

bool assess(const System& system, RouteFit& r) {
  // Of the weighted residuals, where weighting makes them white. The weights of loglog and shift
  // are not the inverse of their covariance.
  const bool weighted_white = r.noise.empty() || !r.rolls.empty();
  r.whiteness = weighted_white ? ljung_box(r.minimum.f, r.minimum.theta.size(), r.runs)
                               : std::numeric_limits<double>::quiet_NaN();
  const bool white = taken_as_white(r);
  r.shared = system.shared;
  if (r.minimum.f.size() > r.minimum.theta.size() && (!white || (!r.noise.empty() && !r.judged)))
    r.Q = orthonormal(system, r.minimum);
  return white;
}

RouteFit fit_route(Route route, const std::vector<FitRun>& runs, const FitOptions& options) {
  if (options.a && !(*options.a > 0))
    fail("a = {} cannot be held: it must be positive", *options.a);
  if (route == Route::loglog) return fit_log_log(runs, options);
  if (route == Route::shift) return fit_shift(runs, options);
  return fit_trajectory(route, runs, options);
}

FitResult fit(Route route, const std::vector<FitRun>& runs, const FitOptions& options) {
  return conclude(fit_route(route, runs, options));
}

void require_records(std::size_t n, std::size_t p) {
  if (n == 0) fail("no record can be fitted");
  if (p == 0) fail("a and b are both held: nothing is left to fit");
  if (n < p) fail("{} record{} cannot determine {} parameters", n, n == 1 ? "" : "s", p);
}

Minimum solve(const System& system, const std::vector<double>& start, const FitOptions& options,
              bool filters_known) {
  if (!options.robust) return minimise(system, start);
  if (filters_known)
    fail(
        "robust fits judge single records, but filters have spread each outlier over many: fit the "
        "raw column");
  return minimise_robust(system, start);
}

}  // namespace rolling
