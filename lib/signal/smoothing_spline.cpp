// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/smoothing_spline.h"

#include <algorithm>
#include <cmath>

#include "base/golden_section.h"

namespace rolling {

// Notation of Green and Silverman (1994), Nonparametric Regression and Generalized Linear Models,
// section 2.3. The second derivatives g at the inner knots solve (R + alpha Q^T Q) g = Q^T y; the
// values of the spline are y - alpha Q g.

/// Solves for the second derivatives and returns the score of the modified generalised
/// cross-validation, RSS / (n - 1.4 tr A)^2, where A is the matrix of the smoother; infinite if the
/// root of the denominator is not positive. RSS = alpha^2 |Q g|^2 and n - tr A = alpha tr(B^-1 Q^T
/// Q), B = R + alpha Q^T Q; these forms have no cancellation, however small or large alpha is.
double SplineDerivative::solve(double alpha) {
  const std::size_t m = qy_.size();
  for (std::size_t j = 0; j < m; ++j) {
    D_[j] = (h_[j] + h_[j + 1]) / 3 + alpha * q0_[j];
    L1_[j] = h_[j + 1] / 6 + alpha * q1_[j];
    L2_[j] = alpha * q2_[j];
    g_[j + 1] = qy_[j];
    if (j >= 1) {
      D_[j] -= L1_[j - 1] * L1_[j - 1] * D_[j - 1];
      L1_[j] -= L1_[j - 1] * L2_[j - 1] * D_[j - 1];
      g_[j + 1] -= L1_[j - 1] * g_[j];
    }
    if (j >= 2) {
      D_[j] -= L2_[j - 2] * L2_[j - 2] * D_[j - 2];
      g_[j + 1] -= L2_[j - 2] * g_[j - 1];
    }
    L1_[j] /= D_[j];
    L2_[j] /= D_[j];
  }
  // Backward substitution: the solution and the three bands of B^-1 that the trace needs (s01 is
  // the element (j, j+1)); beyond the last row they are 0.
  double trace = 0;
  double s11 = 0;
  double s12 = 0;
  double s22 = 0;
  for (std::size_t j = m; j-- > 0;) {
    g_[j + 1] = g_[j + 1] / D_[j] - L1_[j] * g_[j + 2] - L2_[j] * g_[j + 3];
    const double s01 = -L1_[j] * s11 - L2_[j] * s12;
    const double s02 = -L1_[j] * s12 - L2_[j] * s22;
    const double s00 = 1 / D_[j] - L1_[j] * s01 - L2_[j] * s02;
    trace += q0_[j] * s00 + 2 * q1_[j] * s01 + 2 * q2_[j] * s02;
    s22 = s11;
    s12 = s01;
    s11 = s00;
  }
  double square = 0;
  for (std::size_t i = 0; i < m + 2; ++i) square += Qg(i) * Qg(i);
  constexpr double weight = 1.4;
  const double freedom = weight * trace - (weight - 1) * static_cast<double>(m + 2) / alpha;
  return freedom > 0 ? square / (freedom * freedom) : INFINITY;
}

/// An element of Q g: how much the third derivative jumps at a knot.
double SplineDerivative::Qg(std::size_t i) const {
  const auto third = [this](std::size_t k) { return (g_[k + 1] - g_[k]) / h_[k]; };
  double jump = 0;
  if (i < h_.size()) jump += third(i);
  if (i > 0) jump -= third(i - 1);
  return jump;
}

std::span<const double> SplineDerivative::finish() {
  const std::size_t n = run_.size();
  if (n == 0) return {};
  require_slope(n);
  const Units units(run_);
  std::ranges::transform(run_, run_.begin(), units);
  const auto step = [this](std::size_t i) { return run_[i + 1].t - run_[i].t; };
  const auto difference = [this](std::size_t i) { return run_[i + 1].y - run_[i].y; };
  const double unit = (run_.back().t - run_.front().t) / static_cast<double>(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) h_.push_back(step(i) / unit);
  const std::size_t m = n - 2;
  for (auto* numbers : {&qy_, &q0_, &q1_, &q2_, &D_, &L1_, &L2_}) numbers->resize(m);
  g_.resize(n + 1);
  const auto inverse = [this](std::size_t i) { return i < h_.size() ? 1 / h_[i] : 0; };
  for (std::size_t j = 0; j < m; ++j) {
    const double a = inverse(j);
    const double b = inverse(j + 1);
    const double c = inverse(j + 2);
    qy_[j] = difference(j + 1) * b - difference(j) * a;
    q0_[j] = a * a + (a + b) * (a + b) + b * b;
    q1_[j] = -b * (a + 2 * b + c);
    q2_[j] = b * c;
  }

  // The range of alpha reaches from no effect between neighbours to a straight line over a thousand
  // of them.
  constexpr double lowest = -6;
  constexpr double highest = 12;
  constexpr double coarse = 0.5;
  const auto worth = [this](double exponent) { return -solve(std::pow(10, exponent)); };
  Largest best{lowest, worth(lowest)};
  for (double e = lowest + coarse; e <= highest; e += coarse)
    if (const double now = worth(e); now > best.value) best = {e, now};
  best = golden_section(std::max(lowest, best.at - coarse), std::min(highest, best.at + coarse),
                        1e-4, worth);
  const double alpha = std::pow(10, best.at);
  solve(alpha);

  // A difference of readings, unlike one of values, loses no digits to what they have in common.
  const auto rise = [&](std::size_t i) {
    return (difference(i) - alpha * (Qg(i + 1) - Qg(i))) / h_[i];
  };
  slopes_.reserve(n);
  for (std::size_t i = 0; i + 1 < n; ++i)
    slopes_.push_back((rise(i) - h_[i] * (2 * g_[i] + g_[i + 1]) / 6) / unit);
  slopes_.push_back((rise(n - 2) + h_[n - 2] * g_[n - 2] / 6) / unit);
  for (double& slope : slopes_) slope = std::ldexp(slope, units.y - units.t);
  return slopes_;
}

}  // namespace rolling
