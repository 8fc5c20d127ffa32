// The straight line of ln D on ln v: linear, but a different estimator from least squares on D (each record is weighted by D^2).
#include "base/error.h"
#include "fit/routes.h"
#include "rolling/power_law.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rolling {

namespace {

/// Mean and standard deviation of ln(1 + e) for normal e of standard deviation s, of those with 1 + e > 0, which have a logarithm.
struct Logarithm {
  double mean, sd;
};
Logarithm of_noise(double s) {
  constexpr int steps = 400;
  double weight = 0, sum = 0, squares = 0;
  for (int i = 0; i < steps; ++i) {
    const double z = 6 * ((i + 0.5) * 2 / steps - 1), w = std::exp(-z * z / 2);
    if (1 + s * z <= 0) continue;
    const double log = std::log1p(s * z);
    weight += w;
    sum += w * log;
    squares += w * log * log;
  }
  return {sum / weight, std::sqrt(squares / weight - sum / weight * (sum / weight))};
}

}  // namespace

RouteFit fit_log_log(const std::vector<FitRun>& all, const FitOptions& options) {
  ShiftRecords records(all, options, true);
  if (records.v.empty() && records.left_out) fail("no record has v > 0 and D > 0: there is no logarithm to fit");
  KnownNoise noise;
  std::vector<double> expected;  // of the logarithm of the noise
  PowerLaw start{1, 0};
  if (records.filters_known()) {  // the noise of ln D is that of D over D: its size, and D itself, are what least squares on D finds
    const RouteFit law = fit_shift(all, options);
    start = {law.a.value, law.b.value};
    const double sigma = std::sqrt(law.noise.variance(law.minimum.f, orthonormal(law.minimum)));
    const auto noise_of = [&](const std::vector<double>& excess) {
      const auto around = records.smoothed(law.a.value, law.b.value);
      std::vector<double> scale;
      for (double d : around.D) scale.push_back(d > 0 ? 1 / d : 1e100);
      return records.noise(law.b.value, around, scale, excess);
    };
    // A D that is not well above its noise has no logarithm worth the name, and leaving out D <= 0 would favour the large ones.
    std::vector<bool> drowned;
    for (double size : noise_of({}).sizes()) drowned.push_back(sigma * size > 0.4);
    records.leave_out(drowned);
    if (records.v.empty()) fail("no record has a D of 2.5 times its noise: there is no logarithm to fit");
    std::vector<double> excess;  // what the curved logarithm adds to the noise
    for (double size : noise_of({}).sizes()) {
      const double s = sigma * size;
      const auto [mean, sd] = of_noise(s);
      expected.push_back(mean);
      excess.push_back(std::sqrt(std::max(sd * sd - s * s, 0.0)));
    }
    noise = noise_of(excess);
  }
  const auto& v = records.v;
  const std::size_t n = v.size(), p = !options.a + !options.b;
  require_records(n, p);
  if (!options.b && std::all_of(v.begin(), v.end(), [&](double x) { return x == v[0]; })) fail("all speeds are equal: b cannot be determined");

  // Parameters: ln D at the mean of ln v (so the sums are centred and the columns orthogonal), and b.
  const double L = records.log_v_ref;
  const std::vector<double>& log_v = records.log_v;
  std::vector<double> log_D(n);
  std::transform(records.D.begin(), records.D.end(), log_D.begin(), [](double x) { return std::log(x); });
  const auto exponent = [&](const std::vector<double>& theta) { return options.b ? *options.b : theta[p - 1]; };
  const auto height = [&](const std::vector<double>& theta) { return options.a ? std::log(*options.a) + exponent(theta) * L : theta[0]; };
  const System system{n, p, [&](const std::vector<double>& theta, std::vector<double>& f, std::vector<double>& J) {
    const double b = exponent(theta), h = height(theta);
    for (std::size_t i = 0; i < n; ++i) {
      const double log_u = log_v[i] - L;
      f[i] = h + b * log_u - log_D[i];
      if (!options.a) J[i * p] = 1;
      if (!options.b) J[i * p + p - 1] = options.a ? log_v[i] : log_u;
    }
    if (!expected.empty()) {  // what smoothing does to the law, and the logarithm to the noise
      const double a = std::exp(h - b * L);
      const auto s = records.smoothed(a, b);
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
  std::vector<double> theta;
  if (!options.a) theta.push_back(std::log(start.a) + start.b * L);
  if (!options.b) theta.push_back(start.b);
  Minimum minimum = solve(system, theta, options, records.filters_known());
  const double b = exponent(minimum.theta), a = std::exp(height(minimum.theta) - b * L);
  return std::move(records).hand_over(system, std::move(minimum), noise, options.a.value_or(a), a, b);
}

}  // namespace rolling
