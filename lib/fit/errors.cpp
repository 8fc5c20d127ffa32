#include "fit/errors.h"

#include <fmt/core.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "contact/contact.h"
#include "contact/uncertain_number.h"
#include "base/by_run.h"
#include "base/dot.h"

namespace rolling {

void solve_transposed(const double* R, std::span<double> g) {
  const std::size_t q = g.size();
  for (std::size_t j = 0; j < q; ++j) {
    for (std::size_t k = 0; k < j; ++k) g[j] -= R[k * q + j] * g[k];
    g[j] /= R[j * q + j];
  }
}

double Spread::operator()(std::vector<double> g, std::vector<double> h, std::size_t run) const {
  const std::size_t first = run * q_ * q_;
  solve_transposed(&R_[first], g), solve_transposed(&R_[first], h);
  double sum = 0;
  for (std::size_t i = 0; i < q_; ++i)
    for (std::size_t j = 0; j < q_; ++j) sum += g[i] * M_[first + i * q_ + j] * h[j];
  return sum;
}

std::vector<double> orthonormal(const System& system, const Minimum& m) {
  const std::size_t q = system.columns();
  std::vector<double> Q(m.f.size() * q);
  double* row = Q.data();
  system.evaluate(m.theta, [&](std::size_t run, std::span<double> f, std::span<double> J) {
    for (std::size_t i = 0; i < f.size(); ++i, row += q) {
      for (std::size_t j = 0; j < q; ++j) row[j] = J[j * f.size() + i];
      solve_transposed(&m.R[run * q * q], {row, q});
    }
  });
  return Q;
}

void add_shared(std::vector<double>& M, std::size_t columns, std::size_t shared) {
  const std::size_t square = columns * columns;
  for (std::size_t i = columns - shared; i < columns; ++i)
    for (std::size_t j = columns - shared; j < columns; ++j) {
      double sum = 0;
      for (std::size_t at = i * columns + j; at < M.size(); at += square) sum += M[at];
      for (std::size_t at = i * columns + j; at < M.size(); at += square) M[at] = sum;
    }
}

double lagged(std::span<const double> r, std::span<const std::size_t> runs, std::size_t lag) {
  double sum = 0;
  for (const auto run : by_run(r, runs))
    if (run.size() > lag) sum += dot(run.first(run.size() - lag), run.subspan(lag));
  return sum;
}

double ljung_box(std::span<const double> r, std::size_t p, std::span<const std::size_t> runs) {
  const double n = static_cast<double>(r.size()), all = lagged(r, runs, 0);
  if (!(all > 0)) return 1;
  const std::size_t lags = std::clamp<std::size_t>(r.size() / 10, 1, 10);
  double Q = 0, least = 1;
  for (std::size_t k = 1; k <= lags; ++k) {
    const double rho = lagged(r, runs, k) / all + static_cast<double>(p) / n;
    Q += n * (n + 2) * rho * rho / (n - static_cast<double>(k));
    if (k == 1 || k == lags) least = std::min(least, gsl_cdf_chisq_Q(Q, static_cast<double>(k)));
  }
  return least;
}

double breusch_pagan(std::span<const double> residuals, std::span<const std::size_t> runs) {
  // n R^2 of the regression of the squared residuals on the first two Legendre polynomials of the
  // position u in the run (orthogonal up to 1/n^2) has a chi-square distribution with two degrees
  // of freedom.
  const double n = static_cast<double>(residuals.size());
  const double mean = lagged(residuals, runs, 0) / n;
  double P1 = 0, P2 = 0, along1 = 0, along2 = 0, all = 0;
  for (const auto run : by_run(residuals, runs))
    for (std::size_t i = 0; i < run.size(); ++i) {
      const double u = (2 * static_cast<double>(i) + 1) / static_cast<double>(run.size()) - 1,
                   p2 = (3 * u * u - 1) / 2, square = run[i] * run[i] - mean;
      P1 += u * u;
      P2 += p2 * p2;
      along1 += u * square;
      along2 += p2 * square;
      all += square * square;
    }
  if (!(all > 0) || !(P1 > 0) || !(P2 > 0)) return 1;
  return gsl_cdf_chisq_Q(n * (along1 * along1 / P1 + along2 * along2 / P2) / all, 2);
}

namespace {

/// x[i] - rho x[i - 1] for rows of p numbers. The first row of each run is multiplied by sqrt(1 -
/// rho^2), so that its variance is the same.
std::vector<double> prewhitened(std::span<const double> x, std::size_t p,
                                std::span<const std::size_t> runs, double rho) {
  std::vector<double> e(x.begin(), x.end());
  for (const auto run : by_run(e, runs, p)) {
    for (std::size_t i = run.size(); i-- > p;) run[i] -= rho * run[i - p];
    for (std::size_t i = 0; i < std::min(p, run.size()); ++i) run[i] *= std::sqrt(1 - rho * rho);
  }
  return e;
}

double correlation_of_neighbours(std::span<const double> r, std::span<const std::size_t> runs) {
  return std::clamp(lagged(r, runs, 1) / lagged(r, runs, 0), -0.97, 0.97);
}

/// The sum of w(|i - j|) u_i u_j^T over the rows of one run, with w(l) = 1 - l/(width + 1) up to
/// lags of half the run. The triangular weights are the autocorrelation of a box, so that the sum
/// is a sum of squares of moving sums, at a cost that does not depend on the width. Where the limit
/// of half the run cuts the triangle off, the remaining part is a box.
std::vector<double> bartlett(std::span<const double> u, std::size_t q, std::size_t width) {
  const std::size_t m = u.size() / q, most = std::min({width, m / 2, m - 1});
  std::vector<double> P((m + 1) * q), S(q * q, 0), sum(q);  // P: cumulative sums
  for (std::size_t i = 0; i < m * q; ++i) P[i + q] = P[i] + u[i];
  const auto sum_over = [&](std::size_t from, std::size_t to) {
    for (std::size_t j = 0; j < q; ++j) sum[j] = P[to * q + j] - P[from * q + j];
  };
  const double triangle = 1 / static_cast<double>(width + 1),
               box = 1 - static_cast<double>(most + 1) * triangle;
  for (std::size_t end = 1; end <= m + most; ++end) {
    sum_over(end > most + 1 ? end - most - 1 : 0, std::min(end, m));
    add_outer(S, triangle, sum, sum);
  }
  for (std::size_t i = 0; box > 0 && i < m; ++i) {
    sum_over(i > most ? i - most : 0, std::min(i + most + 1, m));
    add_outer(S, box, u.subspan(i * q, q), sum);
  }
  return S;
}

}  // namespace

std::vector<double> newey_west(std::span<const double> scores, std::size_t p,
                               std::span<const double> residuals,
                               std::span<const std::size_t> runs) {
  const double n = static_cast<double>(residuals.size()), fitted = static_cast<double>(p);
  const std::size_t q = scores.size() / residuals.size();
  // A fit of p smooth terms lowers the lag-1 correlation of its residuals by (p (1 + AR) + 2 AR)/n
  // (Kendall 1954, Biometrika 41, 403, for p = 1).
  const double AR = std::clamp(
      (n * correlation_of_neighbours(residuals, runs) + fitted) / std::max(n - fitted - 2, 1.0),
      -0.97, 0.97);
  const auto u = prewhitened(scores, q, runs, AR);
  const double rho = correlation_of_neighbours(prewhitened(residuals, 1, runs, AR), runs);
  const double alpha = 4 * rho * rho / ((1 - rho * rho) * (1 - rho * rho));
  const auto width = static_cast<std::size_t>(std::ceil(1.1447 * std::cbrt(alpha * n)));
  std::vector<double> all;
  for (const auto run : by_run(u, runs, q))
    for (double x : bartlett(run, q, width)) all.push_back(x / ((1 - AR) * (1 - AR)));
  return all;
}

namespace {

/// The sum of u u^T over the rows of each run (q numbers in each row), row by row, run by run.
std::vector<double> outer_products(std::span<const double> u, std::size_t q,
                                   std::span<const std::size_t> runs) {
  std::vector<double> all;
  for (const auto run : by_run(u, runs, q)) {
    std::vector<double> S(q * q);
    for (std::size_t i = 0; i < run.size(); i += q)
      add_outer(S, 1, run.subspan(i, q), run.subspan(i, q));
    all.insert(all.end(), S.begin(), S.end());
  }
  return all;
}

Sources sources_of(const Fitted& fit) {
  if (fit.raw_noise) return fit.raw_noise->sources;
  std::vector<double> Q = orthonormal(fit.system, fit.minimum);
  if (!fit.filters_known()) return {fit.minimum.f, fit.system.runs, std::move(Q)};
  return {fit.noise->explain(fit.minimum.f), fit.noise->sources(),
          fit.noise->through(std::move(Q), fit.system.columns()), fit.means_taken()};
}

/// The meat B^T B of each run, for sources of variance one and known filters.
std::vector<double> meat_of(const Fitted& fit) {
  const std::size_t q = fit.system.columns();
  if (!fit.raw_noise) return fit.noise->meat(orthonormal(fit.system, fit.minimum), q);
  return outer_products(fit.raw_noise->sources.B, q, fit.raw_noise->sources.runs);
}

/// The raw noise without its sources. The expectation of f f^T is the variance times A A^T, A = W
/// E, before the fit, and the fit removes the component along Q. Hence the expectation of |f|^2 is
/// the variance times tr((I - Q Q^T) A A^T) = tr A A^T - |B|^2.
RawNoise raw_noise_of(const Fitted& fit, const std::vector<double>& meat) {
  if (fit.raw_noise) return *fit.raw_noise;
  const std::size_t q = fit.system.columns();
  double taken = 0;
  for (std::size_t i = 0; i < meat.size(); ++i) taken += i % (q * q) % (q + 1) == 0 ? meat[i] : 0;
  RawNoise raw{fit.minimum.rss / (fit.noise->trace() - taken), {}, {}};
  raw.innovations = fit.noise->innovations(fit.minimum.f, raw.innovation_runs);
  return raw;
}

/// The meat of the classical covariance, s^2 I.
std::vector<double> classical(const Fitted& fit, double variance) {
  const std::size_t q = fit.system.columns();
  std::vector<double> M(fit.minimum.R.size(), 0);
  for (std::size_t i = 0; i < M.size(); i += q * q)
    for (std::size_t j = 0; j < q; ++j) M[i + j * (q + 1)] = variance;
  return M;
}

/// The meat that allows for noise that is uneven (HC3 for single records) or correlated.
std::vector<double> consistent_meat(const Fitted& fit, Errors kind, double variance) {
  const std::size_t q = fit.system.columns();
  Sources from = sources_of(fit);
  // HC3: the fit multiplies the noise of a residual by 1 - h, with h its leverage (MacKinnon and
  // White 1985, J. Econometrics 29, 305).
  const bool by_leverage = kind == Errors::uneven && !fit.filters_known();
  for (std::size_t i = 0; i < from.e.size(); ++i) {
    const auto row = std::span(from.B).subspan(i * q, q);
    const double h = by_leverage ? std::min(dot(row, row), 0.99) : 0;
    for (double& score : row) score = score * from.e[i] / (1 - h);
  }
  const auto& scores = from.B;
  std::vector<double> M =
      kind == Errors::uneven
          ? outer_products(scores, q, from.runs)
          : newey_west(scores, fit.minimum.theta.size() + from.means_taken, from.e, from.runs);
  if (by_leverage) return M;
  // The fit has removed part of the noise from the residuals; the ratio of the variances corrects
  // for that.
  const double shown = dot(from.e, from.e) / static_cast<double>(from.e.size());
  for (double& x : M) x *= variance / shown;
  return M;
}

/// The estimator that suits the noise; `white` if the noise may be white and even.
Errors errors_of(std::span<const double> noise, std::span<const std::size_t> runs, double whiteness,
                 Errors white) {
  if (whiteness <= not_white) return Errors::autocorrelation;
  if (breusch_pagan(noise, runs) <= 0.01) return Errors::uneven;
  // With 60 records the test often misses an autocorrelation of 0.5, although the classical errors
  // are then only half as large as they should be. This limit gives Newey-West errors to one in ten
  // records with white noise, at a cost of 1 to 2 % in their size.
  return whiteness <= 0.1 && lagged(noise, runs, 1) > 0 ? Errors::autocorrelation : white;
}

}  // namespace

RawNoise raw_noise_of(const Fitted& fit) {
  RawNoise raw = raw_noise_of(fit, meat_of(fit));
  raw.sources = {fit.noise->explain(fit.minimum.f), fit.noise->sources(), {}, fit.means_taken()};
  return raw;
}

Uncertainty uncertainty_of(const Fitted& fit) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t n = fit.minimum.f.size(), p = fit.minimum.theta.size(),
                    q = fit.system.columns();
  const auto& R = fit.minimum.R;
  if (n <= p) return {Errors::none, nan, nan, {R, std::vector<double>(R.size(), nan), q}};
  std::vector<double> M;
  std::optional<RawNoise> raw;
  if (fit.filters_known()) M = meat_of(fit), raw = raw_noise_of(fit, M);
  const auto& noise = raw ? raw->innovations : fit.minimum.f;
  const auto& runs = raw ? raw->innovation_runs : fit.system.runs;
  const double variance = raw ? raw->variance : fit.minimum.rss / static_cast<double>(n - p),
               whiteness = ljung_box(noise, p, runs);
  Errors kind = raw                     ? Errors::filters
                : fit.noise->inferred() ? Errors::differences
                                        : Errors::classical;
  if (n >= 30) kind = errors_of(noise, runs, whiteness, kind);
  if (kind == Errors::classical || kind == Errors::differences)
    return {kind, whiteness, variance, {R, classical(fit, variance), q}};
  if (kind == Errors::filters)
    for (double& x : M) x *= variance;
  else M = consistent_meat(fit, kind, variance);
  add_shared(M, q, fit.system.shared);
  return {kind, whiteness, variance, {R, std::move(M), q}};
}

NoiseErrors noise_errors(const Fitted& fit, const Uncertainty& by) {
  const auto sigma = [&](const Quantity& x, std::size_t run = 0) {
    const bool fixed =
        std::all_of(x.gradient.begin(), x.gradient.end(), [](double slope) { return slope == 0; });
    return fixed ? 0 : std::sqrt(by.covariance(x.gradient, x.gradient, run));
  };
  ErrorShare share{"noise", sigma(fit.a), sigma(fit.b)};
  if (share.a != 0 && share.b != 0) share.together = by.covariance(fit.a.gradient, fit.b.gradient);
  if (fit.slope) share.slope = sigma(*fit.slope);
  for (std::size_t r = 0; r < fit.v0.size(); ++r) share.v0.push_back(sigma(fit.v0[r], r));
  return {by.kind, by.whiteness, std::move(share)};
}

void NoiseErrors::multiply(double factor) {
  for (double* error : {&share.a, &share.b, &share.slope}) *error *= factor;
  share.together *= factor * factor;
  for (double& error : share.v0) error *= factor;
}

namespace {

Estimate given(Route route, const FitRun& run, const UncertainNumber& number) {
  if (is_trajectory(route)) return {run.body.*number.value, run.given.*number.sigma};
  if (!run.shift_of) return {};
  return {run.shift_of->body.*number.value, run.shift_of->given.*number.sigma};
}

void move(Route route, FitRun& run, const UncertainNumber& number, double by) {
  if (is_trajectory(route)) {
    run.body.*number.value += by;
    return;
  }
  ShiftOf to = *run.shift_of;
  to.body.*number.value += by;
  for (double& D : run.D)
    if (std::isfinite(D))
      D = shift_from_acceleration(to.body, to.geometry, acceleration_of(*run.shift_of, D));
  run.shift_of = to;
}

/// The fit after the number has changed by `by` in each run that has this value and uncertainty.
Fitted fit_with(Route route, std::vector<FitRun> runs, const FitOptions& options,
                const UncertainNumber& number, const Estimate& value, double by) {
  for (FitRun& run : runs)
    if (given(route, run, number) == value) move(route, run, number, by);
  return fit_route(route, runs, options);
}

}  // namespace

std::vector<ErrorShare> shares_of_given(Route route, const std::vector<FitRun>& runs,
                                        const FitOptions& options, const Fitted& fit) {
  FitOptions warm = options;
  warm.start_a = fit.a.value;
  warm.start_b = fit.b.value;
  std::vector<ErrorShare> all;
  for (const UncertainNumber& number : uncertain_numbers) {
    std::vector<Estimate> values;
    for (const FitRun& run : runs) {
      const Estimate value = given(route, run, number);
      if (value.sigma > 0 && std::ranges::find(values, value) == values.end())
        values.push_back(value);
    }
    for (const Estimate& value : values) {
      const double step = value.value == 0 || number.value == &Body::slope
                              ? value.sigma
                              : std::min(value.sigma, 0.1 * std::abs(value.value));
      const Fitted above = fit_with(route, runs, warm, number, value, step),
                   below = fit_with(route, runs, warm, number, value, -step);
      const auto change = [&](const Quantity& high, const Quantity& low) {
        return (high.value - low.value) / 2 * value.sigma / step;
      };
      ErrorShare& share = all.emplace_back();
      share.of = values.size() == 1 ? number.name : fmt::format("{} {}", number.name, value.value);
      const double a = change(above.a, below.a), b = change(above.b, below.b);
      share.a = std::abs(a), share.b = std::abs(b), share.together = a * b;
      share.slope = fit.slope ? change(*above.slope, *below.slope) : 0;
      for (std::size_t r = 0; r < fit.v0.size(); ++r)
        share.v0.push_back(change(above.v0[r], below.v0[r]));
    }
  }
  return all;
}

}  // namespace rolling
