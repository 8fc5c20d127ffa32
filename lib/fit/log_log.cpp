// The straight line of ln D on ln v: linear, but a different estimator from least squares on D
// (each record is weighted by D^2).
#include "base/error.h"
#include "base/large_pages.h"
#include "fit/dot.h"
#include "fit/routes.h"
#include "contact/power_law.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rolling {

namespace {

/// Mean and standard deviation of ln(1 + e) for normal e of standard deviation s, of those with 1 +
/// e > 0, which have a logarithm.
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

/// The line in closed form, which log_u of mean 0 keeps simple. The second round takes away what
/// rounding left in the first; the third is for f.
Minimum straight_line(const ShiftRecords& records, const std::vector<double>& log_D,
                      const FitOptions& options) {
  const auto& log_u = records.log_u;
  const std::size_t n = log_u.size();
  const double at = options.a ? records.log_v_ref : 0;  // where the line is held, or else its mean
  const double N = static_cast<double>(n), xx = dot(log_u.data(), log_u.data(), n) + N * at * at;
  double height = options.a ? std::log(*options.a) : 0, slope = options.b.value_or(0);
  std::vector<double> f;
  reserve_large(f, n);
  f.resize(n);
  for (int round = 0; round < 3; ++round) {
    double sum = 0, product = 0;
    for (std::size_t i = 0; i < n; ++i) {
      f[i] = height + slope * (log_u[i] + at) - log_D[i];
      sum += f[i];
      product += f[i] * (log_u[i] + at);
    }
    if (round == 2) break;
    if (!options.a) height -= sum / N;
    if (!options.b) slope -= product / xx;
  }
  Minimum line{{}, std::move(f), {}, 0};
  if (!options.a) line.theta.push_back(height);
  if (!options.b) line.theta.push_back(slope);
  for (std::size_t r = 0; r < records.runs.size(); ++r) {
    if (!options.a) line.R.push_back(std::sqrt(N));
    if (!options.a && !options.b) line.R.insert(line.R.end(), 2, 0.0);
    if (!options.b) line.R.push_back(std::sqrt(xx));
  }
  line.rss = dot(line.f.data(), line.f.data(), n);
  return line;
}

}  // namespace

RouteFit fit_log_log(const std::vector<FitRun>& all, const FitOptions& options) {
  ShiftRecords records(all, options, true);
  if (records.D.empty() && records.left_out)
    fail("no record has v > 0 and D > 0: there is no logarithm to fit");
  KnownNoise noise;
  std::vector<double> expected;  // of the logarithm of the noise
  PowerLaw start{1, 0};
  if (records.filters_known()) {  // the noise of ln D is that of D over D: its size, and D itself,
                                  // are what least squares on D finds
    const RouteFit law = fit_shift(all, options);
    start = {law.a.value, law.b.value};
    const double sigma = std::sqrt(law.noise.variance(law.minimum.f, law.Q, law.shared));
    const auto noise_of = [&](const std::vector<double>& excess) {
      const auto around = records.smoothed(law.a.value, law.b.value);
      std::vector<double> scale;
      for (double d : around.D) scale.push_back(d > 0 ? 1 / d : 1e100);
      return records.noise(law.b.value, around, scale, excess);
    };
    // A D that is not well above its noise has no logarithm worth the name, and leaving out D <= 0
    // would favour the large ones.
    std::vector<bool> drowned;
    for (double size : noise_of({}).sizes()) drowned.push_back(sigma * size > 0.4);
    records.leave_out(drowned);
    if (records.D.empty())
      fail("no record has a D of 2.5 times its noise: there is no logarithm to fit");
    std::vector<double> excess;  // what the curved logarithm adds to the noise
    for (double size : noise_of({}).sizes()) {
      const double s = sigma * size;
      const auto [mean, sd] = of_noise(s);
      expected.push_back(mean);
      excess.push_back(std::sqrt(std::max(sd * sd - s * s, 0.0)));
    }
    noise = noise_of(excess);
  }
  const auto& log_u = records.log_u;
  const std::size_t n = log_u.size(), p = !options.a + !options.b;
  require_records(n, p);
  if (!options.b &&
      std::all_of(log_u.begin(), log_u.end(), [&](double x) { return x == log_u[0]; }))
    fail("all speeds are equal: b cannot be determined");

  // Parameters: ln D at the mean of ln v (so the sums are centred and the columns orthogonal), and
  // b.
  const double L = records.log_v_ref;
  std::vector<double>& log_D = records.D;
  for (double& x : log_D) x = std::log(x);
  const auto exponent = [&](const std::vector<double>& theta) {
    return options.b ? *options.b : theta[p - 1];
  };
  const auto height = [&](const std::vector<double>& theta) {
    return options.a ? std::log(*options.a) + exponent(theta) * L : theta[0];
  };
  // The line below: gcov counts there nothing but what clears up after an exception.
  const System system{
      records.runs, 0, p,
      [&](const std::vector<double>& theta, const TakeRows& take) {  // GCOVR_EXCL_LINE
    const double b = exponent(theta), h = height(theta), a = std::exp(h - b * L);
    const auto s = expected.empty() ? ShiftRecords::Smoothed{} : records.smoothed(a, b);
    hand_over_rows(
        records.runs, p, !noise.empty(), noise, take,
        [&](std::size_t, std::size_t first, std::vector<double>& f, std::vector<double>& J) {
      for (std::size_t k = 0; k < f.size(); ++k) {
        const std::size_t i = first + k;
        f[k] = h + b * log_u[i] - log_D[i];
        if (!options.a) J[k] = 1;
        if (!options.b) J[J.size() - f.size() + k] = log_u[i] + (options.a ? L : 0);
        if (s.D.empty() || !(s.D[i] > 0)) continue;
        // what smoothing does to the law, and the logarithm to the noise
        f[k] += std::log(s.D[i] / s.law[i]) + expected[i];
        const double by_a = s.D_a[i] / s.D[i] - s.law_a[i] / s.law[i],
                     by_b = s.D_b[i] / s.D[i] - s.law_b[i] / s.law[i];
        if (!options.a) J[k] += by_a * a;
        if (!options.b) J[J.size() - f.size() + k] += by_b - (options.a ? 0 : by_a * a * L);
      }
        });
      }};
  std::vector<double> theta;
  if (!options.a) theta.push_back(std::log(start.a) + start.b * L);
  if (!options.b) theta.push_back(start.b);
  Minimum minimum = records.filters_known() || options.robust
                        ? solve(system, theta, options, records.filters_known())
                        : straight_line(records, log_D, options);
  const double b = exponent(minimum.theta), a = std::exp(height(minimum.theta) - b * L);
  return std::move(records).hand_over(system, std::move(minimum), noise, options.a.value_or(a), a,
                                      b);
}

}  // namespace rolling
