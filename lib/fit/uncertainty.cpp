// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/uncertainty.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/matrix.h"
#include "base/grid.h"
#include "statistics/residuals.h"

namespace rolling {

Matrix orthonormal(const System& system, const Minimum& at) {
  const std::size_t q = system.columns();
  Matrix Q(q);
  for (std::vector<double>& column : Q) column.reserve(at.f.size());
  system.evaluate(at.theta, [&](std::size_t run, std::span<double> f, std::span<double> J) {
    std::vector<double> row(q);
    for (std::size_t i = 0; i < f.size(); ++i) {
      for (std::size_t j = 0; j < q; ++j) row[j] = J[j * f.size() + i];
      at.R.solve_transposed(run, row);
      for (std::size_t j = 0; j < q; ++j) Q[j].push_back(row[j]);
    }
  });
  return Q;
}

namespace {

/// The covariance R^-1 M R^-T of the numbers of a fit, from the meat M (uncertainty.h) of each run.
/// For the parameters that the runs share, M is the sum over the runs.
Matrix covariance_of(const Fitted& fit, std::vector<double> M) {
  const std::size_t own = fit.parameters().own();
  const std::size_t q = fit.parameters().columns();
  for (std::size_t i = own; i < q; ++i)
    for (std::size_t j = own; j < q; ++j)
      for (std::size_t at = i * q + j + q * q; at < M.size(); at += q * q) M[i * q + j] += M[at];
  auto numbers = fit.numbers();
  for (FittedNumber& x : numbers) fit.minimum.R.solve_transposed(x.run, x.gradient);
  Matrix C(numbers.size(), std::vector<double>(numbers.size(), 0));
  for (std::size_t a = 0; a < numbers.size(); ++a)
    for (std::size_t b = 0; b < numbers.size(); ++b) {
      if (numbers[a].run != numbers[b].run) continue;  // nobody asks for it
      for (std::size_t i = 0; i < q; ++i)
        for (std::size_t j = 0; j < q; ++j) {
          const std::size_t of_run = std::min(i, j) < own ? numbers[a].run * q * q : 0;
          C[a][b] += numbers[a].gradient[i] * M[of_run + i * q + j] * numbers[b].gradient[j];
        }
    }
  return C;
}

/// The products U^T U of the rows of each run, row by row, run by run.
std::vector<double> products(const Matrix& U, std::span<const std::size_t> runs) {
  std::vector<double> all;
  for (const auto& run : rows_by_run(U, runs))
    for (const auto x : run)
      for (const auto y : run) all.push_back(dot(x, y));
  return all;
}

std::vector<double> times(double factor, std::vector<double> M) {
  for (double& x : M) x *= factor;
  return M;
}

/// The share of the variance of each residual that the fit has left: 1 - h, h the leverage.
std::vector<double> left_of(const Matrix& Q, std::size_t n) {
  std::vector<double> left(n, 1);
  for (const std::vector<double>& column : Q)
    for (std::size_t i = 0; i < n; ++i) left[i] -= column[i] * column[i];
  for (double& x : left) x = x > 0.01 ? x : 0;
  return left;
}

}  // namespace

SeenNoise seen_noise(const Fitted& fit, Matrix Q) {
  if (fit.noise_of_roll) return *fit.noise_of_roll;
  const auto& f = fit.minimum.f;
  SeenNoise seen{.freedom = fit.degrees_left()};
  seen.e = seen.innovations = f;
  seen.sources = seen.runs = fit.model.rows();
  seen.B = std::move(Q);
  if (fit.noise().from_sources_alone()) {
    seen.innovations = fit.noise().innovations(f, seen.runs);
    Matrix few;
    for (const auto& column : seen.B) few.push_back(fit.noise().innovations(column, seen.runs));
    seen.taken = taken_by(few, seen.runs);
    seen.e = fit.noise().to_sources(f);
    seen.sources = fit.noise().sources();
    for (auto& column : seen.B) column = fit.noise().to_sources(std::move(column));
  } else {
    seen.taken = taken_by(seen.B, seen.runs);
    seen.left = left_of(seen.B, f.size());
  }
  seen.variance = dot(seen.innovations, seen.innovations) / static_cast<double>(seen.freedom);
  return seen;
}

namespace {

/// The meat that allows for noise that is uneven (HC3 for single rows) or correlated.
std::vector<double> consistent_meat(const Fitted& fit, const SeenNoise& seen, Errors kind) {
  // HC3: the fit multiplies the noise of a residual by 1 - h, with h its leverage (MacKinnon and
  // White 1985, J. Econometrics 29, 305).
  const bool by_leverage = kind == Errors::uneven && !seen.left.empty();
  Matrix scores = seen.B;
  for (auto& column : scores)
    for (std::size_t i = 0; i < seen.e.size(); ++i)
      column[i] *= seen.e[i] / (by_leverage ? std::max(seen.left[i], 0.01) : 1);
  const std::size_t taken = fit.minimum.theta.size() + fit.model.means_taken();
  std::vector<double> M = kind == Errors::uneven
                              ? products(scores, seen.sources)
                              : newey_west(std::move(scores), taken, seen.e, seen.sources);
  if (by_leverage) return M;
  // The fit has removed part of the noise from the residuals; the ratio of the variances corrects
  // for that.
  const double shown = dot(seen.e, seen.e) / static_cast<double>(seen.e.size());
  return times(seen.variance / shown, std::move(M));
}

/// The p of the whiteness of the noise, and the estimator that suits it.
std::pair<double, Errors> tested(const Fitted& fit, const SeenNoise& seen) {
  const auto& [noise, runs] = std::tie(seen.innovations, seen.runs);
  Errors white = Errors::classical;
  if (seen.left.empty() || fit.noise().known()) white = Errors::filters;
  if (fit.noise().added().inferred) white = Errors::differences;
  double whiteness = ljung_box(noise, seen.taken, runs);
  if (fit.minimum.f.size() < levels::least_tested) return {whiteness, white};
  const bool uneven = breusch_pagan(noise, runs, seen.left) <= levels::uneven;
  if (uneven && whiteness <= levels::not_white)
    whiteness = ljung_box(noise, seen.taken, runs, uneven);
  if (whiteness <= levels::not_white) return {whiteness, Errors::autocorrelation};
  if (uneven) return {whiteness, Errors::uneven};
  const bool near = whiteness <= levels::nearly_white && lagged(noise, runs, 1) > 0;
  return {whiteness, near ? Errors::autocorrelation : white};
}

/// True if all times are whole multiples of one step from the first: those of a clock.
bool by_a_clock(const std::vector<double>& t) {
  double step = INFINITY;
  for (std::size_t i = 1; i < t.size(); ++i) step = std::min(step, t[i] - t[i - 1]);
  return grid_of(t) > 0.99 * step;
}

}  // namespace

double variance_of_rounding(const Fitted& fit) {
  if (!fit.is_roll() || fit.noise().known()) return 0;
  double sum = 0;
  bool rounded = false;
  for (const ObservedRun& run : fit.model.runs()) {
    sum += std::pow(grid_of(run.y), 2) / 12 * static_cast<double>(run.y.size());
    rounded |= by_a_clock(run.t) || std::ranges::adjacent_find(run.y) != run.y.end();
  }
  const double variance = sum / static_cast<double>(fit.minimum.f.size());
  return rounded || gsl_cdf_chisq_P(fit.minimum.rss / variance,
                                    static_cast<double>(fit.degrees_left())) > levels::not_rounded
             ? variance
             : 0;
}

Uncertainty uncertainty_of(const Fitted& fit, Matrix Q) {
  const SeenNoise seen = seen_noise(fit, std::move(Q));
  const auto with = [&](Errors kind, double whiteness, double variance) {
    const bool consistent = kind == Errors::autocorrelation || kind == Errors::uneven;
    return Uncertainty{
        kind, whiteness,
        covariance_of(fit, consistent ? consistent_meat(fit, seen, kind)
                                      : times(variance, products(seen.B, seen.sources)))};
  };
  if (seen.freedom == 0) return with(Errors::none, NAN, NAN);
  const double floor = variance_of_rounding(fit);
  if (seen.variance < floor) return with(Errors::classical, NAN, floor);
  const auto [whiteness, kind] = tested(fit, seen);
  return with(kind, whiteness, seen.variance);
}

Matrix correlations_of(const Matrix& covariance, std::size_t n) {
  Matrix all(n, std::vector<double>(n, 0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if (const double both = covariance[i][j]; both != 0)
        all[i][j] = both / (std::sqrt(covariance[i][i]) * std::sqrt(covariance[j][j]));
  return all;
}

}  // namespace rolling
