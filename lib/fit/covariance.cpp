#include "fit/covariance.h"

#include "base/error.h"
#include "fit/dot.h"
#include "fit/least_squares.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace rolling {

BandMatrix probe(const LinearFilter& filter, std::span<const double> t) {
  // A row reaches at most 2 reach to either side (that far only at the ends), so of impulses 4
  // reach + 1 apart it sees one.
  const std::size_t n = t.size(), most = std::min(2 * filter.reach, n),
                    spacing = std::min(4 * filter.reach + 1, n);
  const auto span_of = [&](std::size_t i) {
    const bool end = i < filter.reach || i + filter.reach >= n;
    const std::size_t to_side = end ? most : filter.reach, first = i > to_side ? i - to_side : 0;
    return std::pair(first, std::min(n, i + to_side + 1));
  };
  std::vector<std::size_t> start{0};
  for (std::size_t i = 0; i < n; ++i)
    start.push_back(start.back() + span_of(i).second - span_of(i).first);
  std::vector<double> all(start.back()), comb(n);
  for (std::size_t k = 0; k < spacing; ++k) {
    for (std::size_t j = 0; j < n; ++j) comb[j] = j % spacing == k;
    const auto response = filter.apply(t, comb);
    if (response.size() != n)
      fail("a filter of {} gives {} values for {} records", filter.from, response.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
      const auto [first, end] = span_of(i);
      const std::size_t j = first + (k + spacing - first % spacing) %
                                        spacing;  // the first impulse at or after `first`
      if (j < end) all[start[i] + j - first] = response[i];
    }
  }
  BandMatrix L;
  for (std::size_t i = 0; i < n; ++i)
    L.append(span_of(i).first, std::span(all).subspan(start[i], start[i + 1] - start[i]));
  return L;
}

NoiseResponse noise_response(const FilterChain& chain, std::span<const double> t) {
  NoiseResponse response;
  if (chain.empty()) return response;
  std::size_t reach = 0, before = 0,
              after = 0;  // how far beyond the run the filters ahead of the last cut reach
  for (const auto& filter : chain) {
    if (filter.cut_begin) before = reach;
    if (filter.cut_end) after = reach;
    reach += filter.reach;
  }
  const std::size_t n = t.size();
  for (std::size_t k = before; k > 0 && n > 1; --k)
    response.t.push_back(t[0] - static_cast<double>(k) * (t[1] - t[0]));
  response.t.insert(response.t.end(), t.begin(), t.end());
  for (std::size_t k = 1; k <= after && n > 1; ++k)
    response.t.push_back(t[n - 1] + static_cast<double>(k) * (t[n - 1] - t[n - 2]));

  std::span<const double> present = response.t;
  std::size_t still_before = before, still_after = after;
  reach = 0;
  response.source = chain.front().from;
  response.of.emplace(response.source, BandMatrix::identity(present.size()));
  for (const auto& filter : chain) {
    const auto input = response.of.find(filter.from);
    if (input == response.of.end())
      fail("the filters start from two columns, {} and {}: their noises are not known together",
           response.source, filter.from);
    const std::size_t first = filter.cut_begin && n > 1 ? still_before - (before - reach) : 0,
                      last = filter.cut_end && n > 1 ? still_after - (after - reach) : 0;
    if (first + last > 0) {
      for (auto& [name, matrix] : response.of) matrix = matrix.without(first, last);
      present = present.subspan(first, present.size() - first - last);
      still_before -= first;
      still_after -= last;
    }
    response.of.insert_or_assign(filter.to, probe(filter, present) * input->second);
    reach += filter.reach;
  }
  return response;
}

namespace {

std::vector<double> row_norms(const BandMatrix& E) {
  std::vector<double> norms;
  for (std::size_t i = 0; i < E.rows(); ++i)
    norms.push_back(
        std::sqrt(std::inner_product(E.row(i).begin(), E.row(i).end(), E.row(i).begin(), 0.0)));
  return norms;
}

}  // namespace

void KnownNoise::append(BandMatrix E, double share) {
  std::vector<double> norms = row_norms(E);
  std::size_t sources = 0;
  for (std::size_t i = 0; i < E.rows(); ++i)
    sources = std::max(sources, E.first(i) + E.row(i).size());
  const auto middle = norms.begin() + static_cast<std::ptrdiff_t>(norms.size() / 2);
  std::nth_element(norms.begin(), middle, norms.end());
  const double median = norms.empty() ? 0 : *middle;
  Whitener whitener(E, share * median);
  runs_.push_back({std::move(E), sources, median, std::move(whitener)});
}

void KnownNoise::set_floor(double share) {
  for (auto& run : runs_) run.whitener.set_floor(run.E, share * run.median);
}

double KnownNoise::log_size() const {
  double sum = 0;
  for (const auto& run : runs_) sum += run.whitener.log_size();
  return sum;
}

std::vector<double> KnownNoise::sizes() const {
  std::vector<double> all;
  for (const auto& run : runs_) {
    const auto norms = row_norms(run.E);
    all.insert(all.end(), norms.begin(), norms.end());
  }
  return all;
}

void KnownNoise::weight(std::size_t run, std::span<double> f, std::span<double> J) const {
  runs_[run].whitener.apply(f);
  runs_[run].whitener.apply(J);
}

std::vector<double> KnownNoise::middle(const std::vector<double>& f, const std::vector<double>& Q,
                                       std::size_t shared) const {
  const std::size_t p = Q.size() / f.size();
  // theta - truth = -R^-1 Q^T A e with A = W E, e the white noise of the sources: M = sigma^2 (A^T
  // Q)^T (A^T Q).
  const double sigma2 = variance(f, Q, shared);
  std::vector<double> all;
  std::size_t start = 0;
  for (const auto& run : runs_) {
    const std::size_t owned = own.empty() ? 0 : run.E.rows();
    std::vector<double> WQ(owned * p), AQ(run.sources * p, 0), q(run.E.rows()), M(p * p, 0);
    for (std::size_t j = 0; j < p; ++j) {
      for (std::size_t i = 0; i < q.size(); ++i) q[i] = Q[(start + i) * p + j];
      run.whitener.apply_transposed(q);
      for (std::size_t i = 0; i < owned; ++i) WQ[i * p + j] = own[start + i] * q[i];
      for (std::size_t i = 0; i < q.size(); ++i)
        for (std::size_t k = 0; k < run.E.row(i).size(); ++k)
          AQ[(run.E.first(i) + k) * p + j] += run.E.row(i)[k] * q[i];
    }
    for (std::size_t s = 0; s < run.sources; ++s)
      for (std::size_t j = 0; j < p; ++j)
        for (std::size_t k = 0; k < p; ++k) M[j * p + k] += sigma2 * AQ[s * p + j] * AQ[s * p + k];
    for (std::size_t i = 0; i < owned; ++i)
      for (std::size_t j = 0; j < p; ++j)
        for (std::size_t k = 0; k < p; ++k) M[j * p + k] += WQ[i * p + j] * WQ[i * p + k];
    all.insert(all.end(), M.begin(), M.end());
    start += q.size();
  }
  add_shared(all, p, shared);
  return all;
}

double KnownNoise::variance(const std::vector<double>& f, const std::vector<double>& Q,
                            std::size_t shared) const {
  const std::size_t n = f.size(), p = Q.size() / n;
  // sigma^2 is the sum of squares over what noise of size one leaves on average, tr((I - Q Q^T) A
  // A^T), taken from random signs (Hutchinson 1990, Commun. Stat. Simul. 19, 433): 20,000 of them
  // know sigma to 0.5 %.
  const std::size_t trials = std::max<std::size_t>(1, 20000 / n);
  std::mt19937 random(1);
  double expected = 0;
  const auto leave_out = [&](double along) { expected -= along * along; };
  for (std::size_t trial = 0; trial < trials; ++trial) {
    std::vector<double> z, along(p, 0);
    std::size_t start = 0;
    for (const auto& run : runs_) {
      std::vector<double> e(run.sources);
      for (double& sign : e) sign = random() & 1 ? 1 : -1;
      z.clear();
      for (std::size_t i = 0; i < run.E.rows(); ++i) z.push_back(run.E.times(i, e));
      run.whitener.apply(z);
      for (std::size_t i = 0; i < z.size(); ++i) {
        expected += z[i] * z[i];
        for (std::size_t j = 0; j < p; ++j) along[j] += Q[(start + i) * p + j] * z[i];
      }
      std::for_each(along.begin(), along.end() - static_cast<std::ptrdiff_t>(shared), leave_out);
      std::fill(along.begin(), along.end() - static_cast<std::ptrdiff_t>(shared), 0.0);
      start += z.size();
    }
    std::for_each(along.begin(), along.end(), leave_out);
  }
  return std::inner_product(f.begin(), f.end(), f.begin(), 0.0) * static_cast<double>(trials) /
         expected;
}

double lagged(std::span<const double> r, std::span<const std::size_t> runs, std::size_t lag) {
  double sum = 0;
  std::size_t start = 0;
  for (std::size_t n : runs) {
    if (n > lag) sum += dot(&r[start], &r[start + lag], n - lag);
    start += n;
  }
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

namespace {

/// x[i] - rho x[i - 1] for rows of p numbers, the first of each run by its own size.
std::vector<double> prewhitened(std::span<const double> x, std::size_t p,
                                std::span<const std::size_t> runs, double rho) {
  std::vector<double> e(x.begin(), x.end());
  std::size_t start = 0;
  for (std::size_t m : runs) {
    for (std::size_t i = start * p; i < (start + m) * p; ++i)
      e[i] = i < (start + 1) * p ? std::sqrt(1 - rho * rho) * x[i] : x[i] - rho * x[i - p];
    start += m;
  }
  return e;
}

double correlation_of_neighbours(std::span<const double> r, std::span<const std::size_t> runs) {
  return std::clamp(lagged(r, runs, 1) / lagged(r, runs, 0), -0.97, 0.97);
}

}  // namespace

std::vector<double> newey_west(std::span<const double> scores, std::size_t p,
                               std::span<const double> residuals,
                               std::span<const std::size_t> runs) {
  const double n = static_cast<double>(residuals.size()), fitted = static_cast<double>(p);
  const std::size_t q = scores.size() / residuals.size();
  // A fit of p smooth terms takes (p (1 + AR) + 2 AR)/n off the correlation that its residuals show
  // (Kendall 1954, Biometrika 41, 403, for p = 1).
  const double AR = std::clamp(
      (n * correlation_of_neighbours(residuals, runs) + fitted) / std::max(n - fitted - 2, 1.0),
      -0.97, 0.97);
  const auto u = prewhitened(scores, q, runs, AR);
  const double rho = correlation_of_neighbours(prewhitened(residuals, 1, runs, AR), runs);
  const double alpha = 4 * rho * rho / ((1 - rho * rho) * (1 - rho * rho));
  const auto width = static_cast<std::size_t>(std::ceil(1.1447 * std::cbrt(alpha * n)));
  std::vector<double> all;
  std::size_t start = 0;
  for (std::size_t m : runs) {
    std::vector<double> S(q * q, 0);
    for (std::size_t lag = 0; lag <= std::min(width, m / 2) && lag < m; ++lag) {
      const double w =
          (lag ? 1.0 : 0.5) * (1 - static_cast<double>(lag) / static_cast<double>(width + 1));
      for (std::size_t i = start + lag; i < start + m; ++i)
        for (std::size_t j = 0; j < q; ++j)
          for (std::size_t k = 0; k < q; ++k)
            S[j * q + k] +=
                w * (u[i * q + j] * u[(i - lag) * q + k] + u[i * q + k] * u[(i - lag) * q + j]);
    }
    for (double x : S) all.push_back(x / ((1 - AR) * (1 - AR)));
    start += m;
  }
  return all;
}

}  // namespace rolling
