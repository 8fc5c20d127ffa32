// The straight line of ln D on ln v: linear, but a different estimator from least squares on D (each record is weighted by D^2).
#include "base/error.h"
#include "fit/routes.h"

#include <algorithm>
#include <cmath>

namespace rolling {

RouteFit fit_log_log(const std::vector<FitRun>& all, const FitOptions& options) {
  const ShiftRecords records(all, options, true);
  const auto& v = records.v;
  const std::size_t n = v.size(), p = !options.a + !options.b;
  if (n == 0 && records.left_out) fail("no record has v > 0 and D > 0: there is no logarithm to fit");
  require_records(n, p);
  if (!options.b && std::all_of(v.begin(), v.end(), [&](double x) { return x == v[0]; })) fail("all speeds are equal: b cannot be determined");

  // Parameters: ln D at the mean of ln v (so the sums are centred and the columns orthogonal), and b.
  const double L = records.log_v_ref;
  std::vector<double> log_u, log_D;
  for (std::size_t i = 0; i < n; ++i) {
    log_u.push_back(std::log(v[i]) - L);
    log_D.push_back(std::log(records.D[i]));
  }
  const auto exponent = [&](const std::vector<double>& theta) { return options.b ? *options.b : theta[p - 1]; };
  const auto height = [&](const std::vector<double>& theta) { return options.a ? std::log(*options.a) + exponent(theta) * L : theta[0]; };
  KnownNoise noise;
  WeakTerm bias(n, p);
  const System system{n, p, [&](const std::vector<double>& theta, std::vector<double>& f, std::vector<double>& J) {
    for (std::size_t i = 0; i < n; ++i) {
      f[i] = height(theta) + exponent(theta) * log_u[i] + bias.value(i, theta) - log_D[i];
      for (std::size_t j = 0; j < p; ++j) J[i * p + j] = bias.slope(i, j);
      if (!options.a) J[i * p] += 1;
      if (!options.b) J[i * p + p - 1] += log_u[i] + (options.a ? L : 0);
    }
    noise.weight(f, J);
  }};
  Minimum minimum = minimise(system, std::vector<double>(p, 0));
  if (records.filters_known())
    for (int round = 0; round < rounds; ++round) {  // the noise of ln D is that of D over D, both hang on a and b
      const double b = exponent(minimum.theta), h = height(minimum.theta);
      std::vector<double> scale;
      for (double x : log_u) scale.push_back(std::exp(-h - b * x));
      bias = WeakTerm(minimum.theta, [&](const std::vector<double>& point) {
        auto smooth = records.smoothed(std::exp(height(point) - exponent(point) * L), exponent(point));
        for (std::size_t i = 0; i < n; ++i) smooth.D[i] = smooth.D[i] > 0 && smooth.law[i] > 0 ? std::log(smooth.D[i] / smooth.law[i]) : 0;
        return std::move(smooth.D);
      });
      noise = records.noise(b, records.smoothed(std::exp(h - b * L), b), scale);
      minimum = minimise(system, minimum.theta);
    }

  const double b = exponent(minimum.theta), h = height(minimum.theta), a = options.a ? *options.a : std::exp(h - b * L);
  std::vector<double> residuals(n), by_a(p, 0), by_b(p, 0);
  for (std::size_t i = 0; i < n; ++i) residuals[i] = h + b * log_u[i] + bias.value(i, minimum.theta) - log_D[i];
  if (!options.a) by_a[0] = a;
  if (!options.a && !options.b) by_a[1] = -a * L;
  if (!options.b) by_b[p - 1] = 1;
  return {.minimum = std::move(minimum), .runs = records.runs, .residuals = std::move(residuals), .noise = std::move(noise),
          .left_out = records.left_out, .a = {a, by_a}, .b = {b, by_b}, .v0 = {}, .x0 = {}};
}

}  // namespace rolling
