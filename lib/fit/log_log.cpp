// The straight line of ln D on ln v: linear, but a different estimator from least squares on D (each record is weighted by D^2).
#include "base/error.h"
#include "fit/routes.h"

#include <algorithm>
#include <cmath>

namespace rolling {

namespace {

/// Mean of ln(1 + e) for normal e of standard deviation s, of those with 1 + e > 0, which have a logarithm.
double mean_log(double s) {
  constexpr int steps = 400;
  double sum = 0, weight = 0;
  for (int i = 0; i < steps; ++i) {
    const double z = 6 * ((i + 0.5) * 2 / steps - 1), w = std::exp(-z * z / 2);
    if (1 + s * z <= 0) continue;
    sum += w * std::log1p(s * z);
    weight += w;
  }
  return sum / weight;
}

}  // namespace

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
  bool smoothed = false;         // whether what smoothing does to the law is part of the model
  std::vector<double> expected;  // and what the logarithm does to the noise
  const System system{n, p, [&](const std::vector<double>& theta, std::vector<double>& f, std::vector<double>& J) {
    for (std::size_t i = 0; i < n; ++i) {
      f[i] = height(theta) + exponent(theta) * log_u[i] - log_D[i];
      if (!options.a) J[i * p] = 1;
      if (!options.b) J[i * p + p - 1] = log_u[i] + (options.a ? L : 0);
    }
    if (smoothed) {
      const double a = std::exp(height(theta) - exponent(theta) * L);
      const auto s = records.smoothed(a, exponent(theta));
      for (std::size_t i = 0; i < n; ++i) {
        if (!(s.D[i] > 0)) continue;
        f[i] += std::log(s.D[i] / s.law[i]) + expected[i];
        const double by_a = s.D_a[i] / s.D[i] - s.law_a[i] / s.law[i], by_b = s.D_b[i] / s.D[i] - s.law_b[i] / s.law[i];
        if (!options.a) J[i * p] += by_a * a;
        if (!options.b) J[i * p + p - 1] += by_b - (options.a ? 0 : by_a * a * L);
      }
    }
    noise.weight(f, J);
  }};
  if (records.filters_known()) {  // the noise of ln D is that of D over D: its size, and D itself, are what least squares on D finds
    const RouteFit law = fit_shift(all, options);
    const auto around = records.smoothed(law.a.value, law.b.value);
    std::vector<double> scale;
    for (double d : around.D) scale.push_back(d > 0 ? 1 / d : 0);
    noise = records.noise(law.b.value, around, scale);
    const double sigma = std::sqrt(law.noise.variance(law.minimum.f, orthonormal(law.minimum)));
    for (double size : noise.sizes()) expected.push_back(mean_log(sigma * size));
    smoothed = true;
  }
  Minimum minimum = solve(system, std::vector<double>(p, 0), options, records.filters_known());

  const double b = exponent(minimum.theta), h = height(minimum.theta), a = options.a ? *options.a : std::exp(h - b * L);
  std::vector<double> residuals(n), by_a(p, 0), by_b(p, 0), unused(n * p);
  KnownNoise known;
  if (records.filters_known()) {  // the plain residuals, for rms
    std::swap(noise, known);
    system.evaluate(minimum.theta, residuals, unused);
  } else {
    residuals = minimum.f;
  }
  if (!options.a) by_a[0] = a;
  if (!options.a && !options.b) by_a[1] = -a * L;
  if (!options.b) by_b[p - 1] = 1;
  return {.minimum = std::move(minimum), .runs = records.runs, .residuals = std::move(residuals), .noise = std::move(known),
          .left_out = records.left_out, .a = {a, by_a}, .b = {b, by_b}, .v0 = {}, .x0 = {}, .v = v};
}

}  // namespace rolling
