// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/errors.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/by_run.h"
#include "base/dot.h"
#include "base/grid.h"
#include "statistics/residuals.h"

namespace rolling {

double Spread::operator()(std::vector<double> g, std::vector<double> h, std::size_t run) const {
  const std::size_t first = run * q_ * q_;
  solve_transposed(&R_[first], g), solve_transposed(&R_[first], h);
  double sum = 0;
  for (std::size_t i = 0; i < q_; ++i)
    for (std::size_t j = 0; j < q_; ++j) sum += g[i] * M_[first + i * q_ + j] * h[j];
  return sum;
}

Matrix orthonormal(const Fitted& fit) {
  Matrix Q = jacobian(fit.system, fit.minimum.theta);
  const std::size_t q = Q.size();
  const double* R = fit.minimum.R.data();
  for (const auto& run : rows_by_run(Q, fit.system.runs)) {
    for (std::size_t j = 0; j < q; ++j)
      for (std::size_t i = 0; i < run[j].size(); ++i) {
        for (std::size_t k = 0; k < j; ++k) run[j][i] -= R[k * q + j] * run[k][i];
        run[j][i] /= R[j * q + j];
      }
    R += q * q;
  }
  return Q;
}

namespace {

/// Adds, over the runs, the block of the shared parameters of each run's matrix in M, and writes
/// the sum to every run's block.
void add_shared(std::vector<double>& M, std::size_t columns, std::size_t shared) {
  const std::size_t square = columns * columns;
  for (std::size_t i = columns - shared; i < columns; ++i)
    for (std::size_t j = columns - shared; j < columns; ++j) {
      double sum = 0;
      for (std::size_t at = i * columns + j; at < M.size(); at += square) sum += M[at];
      for (std::size_t at = i * columns + j; at < M.size(); at += square) M[at] = sum;
    }
}

/// In runs as long as these the fit takes nearly nothing of one residual, and what it takes of sums
/// of their products is the limit to a few hundredths.
bool has_long_runs(const Fitted& fit) {
  return fit.minimum.f.size() > 1000 * fit.system.runs.size();
}

}  // namespace

Taken taken_of(const Fitted& fit) {
  if (fit.taken) return *fit.taken;
  if (fit.raw_noise) return fit.raw_noise->taken;
  if (has_long_runs(fit)) return taken_by_few(fit.minimum.theta.size());
  Matrix Q = orthonormal(fit);
  if (!fit.filters_known()) return taken_by(Q, fit.system.runs);
  std::vector<std::size_t> runs;
  for (std::vector<double>& column : Q) column = fit.noise->innovations(column, runs);
  return taken_by(Q, runs);
}

namespace {

/// The products U^T U of the rows of each run, row by row, run by run.
std::vector<double> products(const Matrix& U, std::span<const std::size_t> runs) {
  std::vector<double> all;
  for (const auto& run : rows_by_run(U, runs))
    for (const auto x : run)
      for (const auto y : run) all.push_back(dot(x, y));
  return all;
}

/// For known filters, e of the sources.
Sources estimated(const Fitted& fit) {
  return {fit.noise->to_sources(fit.minimum.f), fit.noise->sources(), {}, fit.means_taken()};
}

Sources sources_of(const Fitted& fit) {
  if (fit.raw_noise) return fit.raw_noise->sources;
  if (!fit.filters_known()) return {fit.minimum.f, fit.system.runs, orthonormal(fit)};
  Sources all = estimated(fit);
  all.B = orthonormal(fit);
  for (std::vector<double>& column : all.B) column = fit.noise->to_sources(std::move(column));
  return all;
}

/// The meat B^T B of each run, for sources of variance one and known filters.
std::vector<double> meat_of(const Fitted& fit) {
  if (!fit.raw_noise) return fit.noise->meat(orthonormal(fit));
  return products(fit.raw_noise->sources.B, fit.raw_noise->sources.runs);
}

/// The variance of the sources of known filters. The expectation of f f^T is the variance times A
/// A^T, A = W E, before the fit, and the fit removes the component along Q. Hence the expectation
/// of |f|^2 is the variance times tr((I - Q Q^T) A A^T) = tr A A^T - |B|^2.
double variance_of(const Fitted& fit, const std::vector<double>& meat) {
  if (fit.raw_noise) return fit.raw_noise->variance;
  const std::size_t q = fit.system.columns();
  double taken = 0;
  for (std::size_t i = 0; i < meat.size(); ++i) taken += i % (q * q) % (q + 1) == 0 ? meat[i] : 0;
  return fit.minimum.rss / (fit.noise->trace() - taken);
}

/// The meat of the classical covariance, s^2 I.
std::vector<double> classical(const Fitted& fit, double variance) {
  const std::size_t q = fit.system.columns();
  std::vector<double> M(fit.minimum.R.size(), 0);
  for (std::size_t i = 0; i < M.size(); i += q * q)
    for (std::size_t j = 0; j < q; ++j) M[i + j * (q + 1)] = variance;
  return M;
}

/// The meat that allows for noise that is uneven (HC3 for single rows) or correlated.
std::vector<double> consistent_meat(const Fitted& fit, Sources from, Errors kind, double variance) {
  // HC3: the fit multiplies the noise of a residual by 1 - h, with h its leverage (MacKinnon and
  // White 1985, J. Econometrics 29, 305).
  const bool by_leverage = kind == Errors::uneven && !fit.filters_known();
  for (std::size_t i = 0; i < from.e.size(); ++i) {
    double h = 0;  // the leverage
    for (const auto& column : from.B) h += by_leverage ? column[i] * column[i] : 0;
    for (auto& column : from.B) column[i] *= from.e[i] / (1 - std::min(h, 0.99));
  }
  const double shown = dot(from.e, from.e) / static_cast<double>(from.e.size());
  std::vector<double> M =
      kind == Errors::uneven
          ? products(from.B, from.runs)
          : newey_west(std::move(from.B), fit.minimum.theta.size() + from.means_taken,
                       std::move(from.e), from.runs);
  if (by_leverage) return M;
  // The fit has removed part of the noise from the residuals; the ratio of the variances corrects
  // for that.
  for (double& x : M) x *= variance / shown;
  return M;
}

/// Which estimator suits the noise, and the p-value of its whiteness.
struct Tested {
  double whiteness;
  Errors kind;
};

/// The share of the variance of each residual that the fit has left: 1 - h, h the leverage.
/// Empty where that is nearly all, and behind known filters.
std::vector<double> left_of(const Fitted& fit, std::size_t n) {
  if (fit.taken || fit.filters_known() || has_long_runs(fit)) return {};
  std::vector<double> left(n, 1);
  for (const std::vector<double>& column : orthonormal(fit))
    for (std::size_t i = 0; i < n; ++i) left[i] -= column[i] * column[i];
  for (double& x : left) x = x > 0.01 ? x : 0;
  return left;
}

Tested tested(std::span<const double> noise, std::span<const std::size_t> runs, const Taken& taken,
              const Fitted& fit) {
  const Errors white = fit.noise->added().inferred           ? Errors::differences
                       : fit.raw_noise || fit.noise->known() ? Errors::filters
                                                             : Errors::classical;
  double whiteness = ljung_box(noise, taken, runs);
  if (fit.minimum.f.size() < 30) return {whiteness, white};
  const std::vector<double> left = left_of(fit, noise.size());
  std::vector<double> alike;  // of one variance, if the noise has one
  for (std::size_t i = 0; i < left.size(); ++i)
    alike.push_back(left[i] > 0 ? noise[i] / std::sqrt(left[i]) : 0);
  const bool uneven = std::min(breusch_pagan(left.empty() ? noise : alike, runs),
                               unequal_runs(noise, runs, left)) <=
                      (runs.size() > 1 ? levels::uneven_runs : levels::uneven);
  if (uneven && whiteness <= levels::not_white) whiteness = ljung_box_uneven(noise, taken, runs);
  if (whiteness <= levels::not_white) return {whiteness, Errors::autocorrelation};
  if (uneven) return {whiteness, Errors::uneven};
  const bool near = whiteness <= levels::nearly_white && lagged(noise, runs, 1) > 0;
  return {whiteness, near ? Errors::autocorrelation : white};
}

/// The mean variance that the rounding of the readings leaves them; 0 behind filters. Gates fix x
/// or v, and t is measured: readings on a grid that are far closer to the roll than rounding would
/// leave them, and of which none repeats, are not rounded.
double variance_of_rounding(const Fitted& fit, double freedom) {
  if (!fit.rolls || fit.noise->known()) return 0;
  double sum = 0;
  bool repeats = false;
  for (const ObservedRun& run : fit.rolls->runs()) {
    sum += std::pow(grid_of(run.y), 2) / 12 * static_cast<double>(run.y.size());
    repeats |= std::ranges::adjacent_find(run.y) != run.y.end();
  }
  const double variance = sum / static_cast<double>(fit.minimum.f.size());
  return repeats || gsl_cdf_chisq_P(fit.minimum.rss / variance, freedom) > levels::not_rounded
             ? variance
             : 0;
}

Tested tested(const Fitted& fit) {
  const Taken taken = taken_of(fit);
  if (fit.raw_noise)
    return tested(fit.raw_noise->innovations, fit.raw_noise->innovation_runs, taken, fit);
  if (!fit.filters_known()) return tested(fit.minimum.f, fit.system.runs, taken, fit);
  std::vector<std::size_t> runs;
  const std::vector<double> innovations = fit.noise->innovations(fit.minimum.f, runs);
  return tested(innovations, runs, taken, fit);
}

}  // namespace

RawNoise raw_noise_of(const Fitted& fit) {
  RawNoise raw{
      variance_of(fit, meat_of(fit)), fit.degrees_left(), {}, {}, taken_of(fit), estimated(fit)};
  if (fit.filters_known())
    raw.innovations = fit.noise->innovations(fit.minimum.f, raw.innovation_runs);
  else raw.innovations = fit.minimum.f, raw.innovation_runs = fit.system.runs;
  return raw;
}

Uncertainty uncertainty_of(const Fitted& fit) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t n = fit.minimum.f.size(), p = fit.minimum.theta.size(),
                    q = fit.system.columns();
  const auto& R = fit.minimum.R;
  if (fit.degrees_left() == 0)
    return {Errors::none, nan, nan, {R, std::vector<double>(R.size(), nan), q}};
  const bool known = fit.filters_known();
  const double freedom = static_cast<double>(n - p), floor = variance_of_rounding(fit, freedom);
  if (fit.minimum.rss < floor * freedom)
    return {Errors::classical, nan, floor, {R, classical(fit, floor), q}};
  const auto [whiteness, kind] = tested(fit);
  const bool consistent = kind == Errors::autocorrelation || kind == Errors::uneven;
  Sources sources;
  std::vector<double> M;
  if (consistent) {
    sources = sources_of(fit);
    if (known) M = products(sources.B, sources.runs);
  } else if (known) {
    M = meat_of(fit);
  }
  const double variance = known ? variance_of(fit, M) : fit.minimum.rss / freedom;
  if (consistent) M = consistent_meat(fit, std::move(sources), kind, variance);
  else if (known)
    for (double& x : M) x *= variance;
  else return {kind, whiteness, variance, {R, classical(fit, variance), q}};
  add_shared(M, q, fit.system.shared);
  return {kind, whiteness, variance, {R, std::move(M), q}};
}

NoiseErrors noise_errors(const Fitted& fit, const Uncertainty& by) {
  const auto is_fixed = [](const FittedNumber& x) {
    return std::ranges::all_of(x.gradient, [](double slope) { return slope == 0; });
  };
  const auto sigma = [&](const FittedNumber& x, std::size_t run = 0) {
    return is_fixed(x) ? 0 : std::sqrt(by.covariance(x.gradient, x.gradient, run));
  };
  ErrorShare share{"noise"};
  for (const FittedNumber& x : fit.coefficients) {
    std::vector<double>& row = share.law.emplace_back();
    for (const FittedNumber& y : fit.coefficients)
      row.push_back(is_fixed(x) || is_fixed(y) ? 0 : by.covariance(x.gradient, y.gradient));
  }
  if (fit.slope) share.slope = sigma(*fit.slope);
  for (std::size_t r = 0; r < fit.v0.size(); ++r) share.v0.push_back(sigma(fit.v0[r], r));
  for (std::size_t r = 0; r < fit.x0.size(); ++r) share.x0.push_back(sigma(fit.x0[r], r));
  return {by.kind, by.whiteness, std::move(share)};
}

Matrix correlations_of(const Matrix& covariance) {
  Matrix all = covariance;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < all.size(); ++j) {
      const double sigmas = std::sqrt(covariance[i][i]) * std::sqrt(covariance[j][j]);
      all[i][j] = covariance[i][j] == 0 ? 0 : covariance[i][j] / sigmas;
    }
  return all;
}

void NoiseErrors::multiply(double factor) {
  for (std::vector<double>& row : share.law)
    for (double& covariance : row) covariance *= factor * factor;
  share.slope *= factor;
  for (std::vector<double>* of_runs : {&share.v0, &share.x0})
    for (double& error : *of_runs) error *= factor;
}

}  // namespace rolling
