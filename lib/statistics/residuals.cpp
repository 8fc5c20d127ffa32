// SPDX-License-Identifier: GPL-3.0-or-later
#include "statistics/residuals.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_randist.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "base/matrix.h"

namespace rolling {

namespace {

/// The sum of the products of numbers that are `lag` rows apart.
double product(std::span<const double> run, std::size_t lag) {
  return run.size() > lag ? dot(run.first(run.size() - lag), run.subspan(lag)) : 0;
}

/// Two sums are tested: z^2 of the first lag, and z^2 with those of the other lags. Each has a p.
/// This is the probability that the smaller p is at most `least`, for white noise. The other lags
/// are independent of z, so it is an integral over z of the normal density times their
/// distribution.
double smaller_of_two(double least, std::size_t lags) {
  if (lags == 1 || least <= 0 || least >= 1) return least;
  const double others = static_cast<double>(lags - 1);
  const double most = gsl_cdf_chisq_Qinv(least, others + 1);
  const double end = std::min(gsl_cdf_ugaussian_Qinv(least / 2), std::sqrt(most));
  const std::unique_ptr<gsl_integration_glfixed_table,
                        decltype(&gsl_integration_glfixed_table_free)>
      table(gsl_integration_glfixed_table_alloc(64), gsl_integration_glfixed_table_free);
  double sum_above = 0;
  for (std::size_t i = 0; i < table->n; ++i) {
    double z = 0;
    double weight = 0;
    gsl_integration_glfixed_point(0, end, i, &z, &weight, table.get());
    sum_above += 2 * weight * gsl_ran_ugaussian_pdf(z) * gsl_cdf_chisq_Q(most - z * z, others);
  }
  // For a small p the complement keeps its digits: |z| is beyond its limit, or the sum is.
  return 2 * gsl_cdf_ugaussian_Q(end) + sum_above;
}

}  // namespace

double lagged(std::span<const double> r, std::span<const std::size_t> runs, std::size_t lag) {
  double sum = 0;
  for (const auto run : by_run(r, runs)) sum += product(run, lag);
  return sum;
}

LagSums taken_by(const Matrix& Q, std::span<const std::size_t> runs) {
  LagSums taken{};
  for (const auto& column : Q)
    for (std::size_t k = 0; k < taken.size(); ++k) taken[k] += lagged(column, runs, k);
  return taken;
}

LagSums taken_by_few(std::size_t p) {
  LagSums taken;
  taken.fill(static_cast<double>(p));
  return taken;
}

double ljung_box(std::span<const double> r, const LagSums& taken, std::span<const std::size_t> runs,
                 bool uneven) {
  const std::size_t lags = std::clamp<std::size_t>(r.size() / 10, 1, taken.size() - 1);
  LagSums sums{};
  LagSums variances{};
  for (const auto run : by_run(r, runs)) {
    std::vector<double> squares;
    for (const double x : run.first(uneven ? run.size() : 0)) squares.push_back(x * x);
    const double n = static_cast<double>(run.size());
    const double sum = product(run, 0);
    const double even = sum * sum / (n * (n + 2));
    for (std::size_t k = 0; k <= lags && k < run.size(); ++k) {
      sums[k] += product(run, k);
      variances[k] += uneven ? product(squares, k) : (n - static_cast<double>(k)) * even;
    }
  }
  const double n = static_cast<double>(r.size());
  if (!(sums[0] > 0 && n > taken[0])) return 1;
  double Q = 0;
  double least = 1;
  for (std::size_t k = 1; k <= lags; ++k) {
    const double sum = sums[k] + taken[k] * sums[0] / (n - taken[0]);
    if (variances[k] > 0) Q += sum * sum / variances[k];
    if (k == 1 || k == lags) least = std::min(least, gsl_cdf_chisq_Q(Q, static_cast<double>(k)));
  }
  return smaller_of_two(least, lags);
}

double breusch_pagan(std::span<const double> residuals, std::span<const std::size_t> runs,
                     std::span<const double> left) {
  // n R^2 of the regression of the squared residuals on the first two Legendre polynomials of the
  // position u in the run and on the mean of each run. They are orthogonal up to 1/n^2.
  const double n = static_cast<double>(residuals.size());
  const double freedom = left.empty() ? n : std::reduce(left.begin(), left.end());
  const double mean = lagged(residuals, runs, 0) / freedom;
  double P1 = 0;
  double P2 = 0;
  double along1 = 0;
  double along2 = 0;
  double between = 0;
  double all = 0;
  auto share = left.begin();
  for (const auto run : by_run(residuals, runs)) {
    double sum = 0;
    double of_run = 0;
    for (std::size_t i = 0; i < run.size(); ++i) {
      const double u = (2 * static_cast<double>(i) + 1) / static_cast<double>(run.size()) - 1;
      const double p2 = (3 * u * u - 1) / 2;
      const double h = left.empty() ? 1 : *share++;
      const double square = h > 0 ? run[i] * run[i] / h - mean : 0;
      P1 += u * u;
      along1 += u * square;
      P2 += p2 * p2;
      along2 += p2 * square;
      sum += h * square;
      of_run += h;
      all += square * square;
    }
    if (of_run > 0) between += sum * sum / of_run;
  }
  if (!(all > 0) || !(P1 > 0) || !(P2 > 0)) return 1;
  return gsl_cdf_chisq_Q(n * (along1 * along1 / P1 + along2 * along2 / P2 + between) / all,
                         static_cast<double>(runs.size() + 1));
}

namespace {

/// Replaces x[i] by x[i] - rho x[i - 1]. The first number of each run is multiplied by
/// sqrt(1 - rho^2), so that its variance is the same.
void prewhiten(std::vector<double>& x, std::span<const std::size_t> runs, double rho) {
  for (const auto run : by_run(x, runs)) {
    for (std::size_t i = run.size(); i-- > 1;) run[i] -= rho * run[i - 1];
    if (!run.empty()) run[0] *= std::sqrt(1 - rho * rho);
  }
}

double correlation_of_neighbours(std::span<const double> r, std::span<const std::size_t> runs) {
  return std::clamp(lagged(r, runs, 1) / lagged(r, runs, 0), -0.97, 0.97);
}

/// The cumulative sums of x, from 0 to that of all.
std::vector<double> cumulative(std::span<const double> x) {
  std::vector<double> sums(x.size() + 1);
  std::partial_sum(x.begin(), x.end(), sums.begin() + 1);
  return sums;
}

/// The sum of w(|i - j|) x_i y_j over one run, given the cumulative sums X and Y of both, with
/// w(l) = 1 - l/(width + 1), and a width of half the run at most. The triangular weights are the
/// autocorrelation of a box, so that the sum is one of products of moving sums, at a cost that does
/// not depend on the width.
double bartlett(std::span<const double> X, std::span<const double> Y, std::size_t width) {
  const std::size_t m = X.size() - 1;
  const std::size_t box = std::min({width, m / 2, m - 1}) + 1;
  double sum = 0;
  for (std::size_t end = 1; end < m + box; ++end) {
    const std::size_t from = end > box ? end - box : 0;
    const std::size_t to = std::min(end, m);
    sum += (X[to] - X[from]) * (Y[to] - Y[from]);
  }
  return sum / static_cast<double>(box);
}

}  // namespace

double autoregression(std::span<const double> residuals, std::size_t fitted,
                      std::span<const std::size_t> runs) {
  const double n = static_cast<double>(residuals.size());
  const double p = static_cast<double>(fitted);
  const double of_noise =
      (n * correlation_of_neighbours(residuals, runs) + p) / std::max(n - p - 2, 1.0);
  return std::clamp(of_noise, -0.97, 0.97);
}

std::vector<double> newey_west(Matrix scores, std::size_t p, std::vector<double> residuals,
                               std::span<const std::size_t> runs) {
  const double n = static_cast<double>(residuals.size());
  const double AR = autoregression(residuals, p, runs);
  for (std::vector<double>& column : scores) prewhiten(column, runs, AR);
  prewhiten(residuals, runs, AR);
  const double rho = correlation_of_neighbours(residuals, runs);
  const double alpha = 4 * rho * rho / ((1 - rho * rho) * (1 - rho * rho));
  const auto width = static_cast<std::size_t>(std::ceil(1.1447 * std::cbrt(alpha * n)));
  std::vector<double> all;
  for (const auto& run : rows_by_run(scores, runs)) {
    Matrix sums;
    for (const auto column : run) sums.push_back(cumulative(column));
    for (const auto& X : sums)
      for (const auto& Y : sums) all.push_back(bartlett(X, Y, width) / ((1 - AR) * (1 - AR)));
  }
  return all;
}

}  // namespace rolling
