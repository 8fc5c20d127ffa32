// SPDX-License-Identifier: GPL-3.0-or-later
#include "statistics/random_effects.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

namespace rolling {
namespace {

RandomEffectsLine line_through(const std::vector<Estimate>& x, const std::vector<double>& g,
                               double tau_square) {
  RandomEffectsLine line;
  line.tau_square = tau_square;
  const auto w = [&](std::size_t i) { return line.weight_of(x[i]); };
  for (std::size_t i = 0; i < x.size(); ++i) line.weight += w(i);
  for (std::size_t i = 0; i < x.size(); ++i) {
    line.mean += w(i) / line.weight * x[i].value;
    line.mean_g += w(i) / line.weight * g[i];
  }
  double together = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double off = g[i] - line.mean_g;
    line.spread += w(i) * off * off;
    together += w(i) * off * (x[i].value - line.mean);
  }
  if (line.spread > 0) line.slope = together / line.spread;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double r = x[i].value - line.mean - line.slope * (g[i] - line.mean_g);
    line.chi2 += w(i) * r * r;
    line.fall += w(i) * w(i) * r * r;
  }
  return line;
}

}  // namespace

// Newton's method on 1/chi^2, which is linear in tau^2 where all errors are equal.
RandomEffectsLine random_effects_line(const std::vector<Estimate>& x, const std::vector<double>& g,
                                      double freedom) {
  double tau_square = 0;
  RandomEffectsLine line = line_through(x, g, 0);
  for (int i = 0; i < 100 && line.chi2 > 0 && std::isfinite(line.weight); ++i) {
    const double step = (line.chi2 / freedom - 1) * line.chi2 / line.fall;
    const double next = std::max(0.0, tau_square + step);
    const bool done = std::abs(next - tau_square) <= 1e-12 * next;
    tau_square = next;
    line = line_through(x, g, tau_square);
    if (done) break;
  }
  return line;
}

double student(double freedom) { return gsl_cdf_tdist_Pinv(0.975, freedom) / 1.96; }

RandomEffectsMean random_effects_mean(const std::vector<Estimate>& x, double freedom) {
  const std::size_t n = x.size();
  const RandomEffectsLine line = random_effects_line(x, std::vector<double>(n, 0), freedom);
  RandomEffectsMean mean{line.mean, line.tau_square, std::vector<double>(n, 0),
                         std::vector<double>(n, 0)};
  if (!std::isfinite(line.weight)) {
    mean.value = x.front().value;
    return mean;
  }
  for (std::size_t i = 0; i < n; ++i) mean.shares[i] = line.weight_of(x[i]) / line.weight;
  // Of the other runs: rest = 1 - h also where that rounds to 0, and the sum of h x.
  std::vector<double> rest(n);
  std::vector<double> sum(n);
  double h_seen = 0;
  double hx_seen = 0;
  const auto add_others = [&](std::size_t i) {
    rest[i] += h_seen;
    sum[i] += hx_seen;
    h_seen += mean.shares[i];
    hx_seen += mean.shares[i] * x[i].value;
  };
  for (std::size_t i = 0; i < n; ++i) add_others(i);
  h_seen = hx_seen = 0;
  for (std::size_t i = n; i-- > 0;) add_others(i);
  double inverse = 0;
  double k_before = 0;  // of the degrees of freedom
  for (std::size_t i = 0; i < n; ++i) {
    const double h = mean.shares[i];
    const double k = h * h / rest[i];
    mean.parts[i] =
        h * std::sqrt(rest[i]) * (x[i].value - sum[i] / rest[i]);  // r/(1 - h) = x - sum/rest
    inverse += h * h + 2 * k * k_before;
    k_before += k;
  }
  // The slope, where it was fitted, has taken one of the N - 1.
  const double left = freedom / static_cast<double>(n - 1);
  const double factor = student(left / inverse) / std::sqrt(left);
  for (double& part : mean.parts) part *= factor;
  return mean;
}

}  // namespace rolling
