#include "fit/fit.h"

#include "base/error.h"
#include "fit/routes.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace rolling {
namespace {

double sum_of_squares(const std::vector<double>& f) { return std::inner_product(f.begin(), f.end(), f.begin(), 0.0); }

/// Of the weighted residuals, where weighting makes them white. The weights of loglog and shift are not the inverse of their covariance.
double whiteness(const RouteFit& r) {
  return r.noise.empty() || !r.rolls.empty() ? ljung_box(r.minimum.f, r.minimum.theta.size(), r.runs) : std::numeric_limits<double>::quiet_NaN();
}

bool taken_as_white(std::size_t n, double significance) { return n < 30 || !(significance <= 0.01); }

FitResult conclude(const RouteFit& r) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t n = r.residuals.size(), p = r.minimum.theta.size();
  FitResult result{.a = r.a.value, .sigma_a = nan, .b = r.b.value, .sigma_b = nan, .corr = 0, .rms = nan, .n = n,
                   .left_out = r.left_out, .whiteness = nan, .v0 = {}, .sigma_v0 = {}, .x0 = {}, .sigma_x0 = {}, .errors = Errors::none};
  std::vector<double> middle(p * p, nan);
  if (n > p) {
    result.rms = std::sqrt(sum_of_squares(r.residuals) / static_cast<double>(n - p));
    result.whiteness = whiteness(r);
    const bool white = taken_as_white(n, result.whiteness);
    if (white && !r.noise.empty() && !r.judged) {
      middle = r.noise.middle(r.minimum.f, orthonormal(r.minimum));
      result.errors = Errors::filters;
    } else if (white) {
      std::fill(middle.begin(), middle.end(), 0);
      for (std::size_t j = 0; j < p; ++j) middle[j * p + j] = r.minimum.rss / static_cast<double>(n - p);
      result.errors = r.judged ? Errors::differences : Errors::classical;
    } else {
      std::vector<double> Q = orthonormal(r.minimum);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < p; ++j) Q[i * p + j] *= r.minimum.f[i];
      middle = newey_west(Q, p, r.minimum.f, r.runs);
      for (double& x : middle) x *= static_cast<double>(n) / static_cast<double>(n - p);
      result.errors = Errors::autocorrelation;
    }
  }
  const Spread covariance(r.minimum.R, middle, p);
  const auto fixed = [](const Quantity& q) { return sum_of_squares(q.gradient) == 0; };
  const auto sigma = [&](const Quantity& q) { return fixed(q) ? 0 : std::sqrt(covariance(q.gradient, q.gradient)); };
  result.sigma_a = sigma(r.a);
  result.sigma_b = sigma(r.b);
  if (!fixed(r.a) && !fixed(r.b) && result.sigma_a != 0 && result.sigma_b != 0)
    result.corr = covariance(r.a.gradient, r.b.gradient) / (result.sigma_a * result.sigma_b);
  for (const auto& q : r.v0) result.v0.push_back(q.value), result.sigma_v0.push_back(sigma(q));
  for (const auto& q : r.x0) result.x0.push_back(q.value), result.sigma_x0.push_back(sigma(q));
  for (double x : {result.a, result.b})
    if (!std::isfinite(x)) fail("the fit gives no finite a and b");
  if (result.errors != Errors::none)
    for (double x : {result.sigma_a, result.sigma_b, result.corr, result.rms})
      if (!std::isfinite(x)) fail("the fit gives no finite errors of a and b");
  if (result.sigma_b > 3) fail("the data do not determine b: it comes out as {:.3g} +- {:.2g}", result.b, result.sigma_b);
  return result;
}

}  // namespace

bool look_white(const RouteFit& r) { return taken_as_white(r.residuals.size(), whiteness(r)); }

RouteFit fit_route(Route route, const std::vector<FitRun>& runs, const FitOptions& options) {
  if (options.a && !(*options.a > 0)) fail("a = {} cannot be held: it must be positive", *options.a);
  if (route == Route::loglog) return fit_log_log(runs, options);
  if (route == Route::shift) return fit_shift(runs, options);
  return fit_trajectory(route, runs, options);
}

FitResult fit(Route route, const std::vector<FitRun>& runs, const FitOptions& options) { return conclude(fit_route(route, runs, options)); }

void require_records(std::size_t n, std::size_t p) {
  if (n == 0) fail("no record can be fitted");
  if (p == 0) fail("a and b are both held: nothing is left to fit");
  if (n < p) fail("{} record{} cannot determine {} parameters", n, n == 1 ? "" : "s", p);
}

Minimum solve(const System& system, const std::vector<double>& start, const FitOptions& options, bool filters_known) {
  if (!options.robust) return minimise(system, start);
  if (filters_known) fail("robust fits judge single records, but filters have spread each outlier over many: fit the raw column");
  return minimise_robust(system, start);
}

}  // namespace rolling
