// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/smoothing_spline.h"

#include <cmath>

#include "base/error.h"
#include "signal/derivative.h"
#include "unit/catch.h"
#include "unit/signal/through.h"

using namespace rolling;

namespace {

Series slopes(const Series& t, const Series& y) { return through(SplineDerivative(), t, y); }

using Matrix = std::vector<std::vector<long double>>;

/// Solves A X = B in long double, with pivots.
Matrix solve(Matrix A, Matrix B) {
  const std::size_t n = A.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t r = k; r < n; ++r)
      if (std::abs(A[r][k]) > std::abs(A[pivot][k])) pivot = r;
    std::swap(A[k], A[pivot]), std::swap(B[k], B[pivot]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == k) continue;
      const long double f = A[r][k] / A[k][k];
      for (std::size_t c = k; c < n; ++c) A[r][c] -= f * A[k][c];
      for (std::size_t c = 0; c < B[r].size(); ++c) B[r][c] -= f * B[k][c];
    }
  }
  for (std::size_t r = 0; r < n; ++r)
    for (long double& x : B[r]) x /= A[r][r];
  return B;
}

/// The same spline by dense matrices: S = (I + alpha Q R^-1 Q^T)^-1, its modified GCV score from S
/// itself, its slopes from the cardinal functions of the natural spline through S y.
struct Dense {
  Series t, y;
  std::size_t n = t.size();
  Matrix K = penalty();

  Matrix penalty() const {
    Matrix Q(n, std::vector<long double>(n - 2, 0)), R(n - 2, std::vector<long double>(n - 2, 0));
    const auto h = [&](std::size_t i) { return static_cast<long double>(t[i + 1]) - t[i]; };
    for (std::size_t j = 0; j + 2 < n; ++j) {
      Q[j][j] = 1 / h(j), Q[j + 1][j] = -1 / h(j) - 1 / h(j + 1), Q[j + 2][j] = 1 / h(j + 1);
      R[j][j] = (h(j) + h(j + 1)) / 3;
      if (j + 3 < n) R[j][j + 1] = R[j + 1][j] = h(j + 1) / 6;
    }
    Matrix Qt(n - 2, std::vector<long double>(n));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j + 2 < n; ++j) Qt[j][i] = Q[i][j];
    const Matrix X = solve(R, Qt);
    Matrix out(n, std::vector<long double>(n, 0));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t k = 0; k + 2 < n; ++k) out[i][j] += Q[i][k] * X[k][j];
    return out;
  }

  long double fit(long double alpha, std::vector<long double>& f) const {
    Matrix A = K, I(n, std::vector<long double>(n, 0));
    for (std::size_t i = 0; i < n; ++i) {
      for (long double& x : A[i]) x *= alpha;
      A[i][i] += 1, I[i][i] = 1;
    }
    const Matrix S = solve(A, I);
    long double rss = 0, left = 0;
    f.assign(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) f[i] += S[i][j] * y[j];
      rss += (y[i] - f[i]) * (y[i] - f[i]), left += 1 - 1.4L * S[i][i];
    }
    return left > 0 ? rss / (left * left) : INFINITY;
  }

  Series best_slopes() const {
    std::vector<long double> f, best;
    long double least = INFINITY;
    const double unit = (t.back() - t.front()) / static_cast<double>(n - 1);
    double at = -6;
    const auto look = [&](double from, double to, double step) {
      for (double e = from; e <= to; e += step)
        if (const long double score = fit(std::pow(10.0L, e) * unit * unit * unit, f);
            score < least)
          least = score, best = f, at = e;
    };
    look(-6, 12, 0.02);
    look(at - 0.02, at + 0.02, 0.0002);
    // The natural spline through the values: slopes s from continuous second derivatives.
    Matrix A(n, std::vector<long double>(n, 0)), b(n, std::vector<long double>(1, 0));
    const auto h = [&](std::size_t i) { return static_cast<long double>(t[i + 1]) - t[i]; };
    const auto rise = [&](std::size_t i) { return (best[i + 1] - best[i]) / h(i); };
    A[0][0] = 2, A[0][1] = 1, b[0][0] = 3 * rise(0);
    A[n - 1][n - 1] = 2, A[n - 1][n - 2] = 1, b[n - 1][0] = 3 * rise(n - 2);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      A[i][i - 1] = h(i), A[i][i] = 2 * (h(i - 1) + h(i)), A[i][i + 1] = h(i - 1);
      b[i][0] = 3 * (h(i) * rise(i - 1) + h(i - 1) * rise(i));
    }
    Series s;
    for (const auto& row : solve(A, b)) s.push_back(static_cast<double>(row[0]));
    return s;
  }
};

}  // namespace

TEST_CASE("smoothing_spline: as dense matrices in long double have it, parameter and all",
          "[signal]") {
  for (const std::size_t n : {3u, 4u, 24u})
    for (const unsigned seed : {1u, 2u, 3u}) {
      const Series t = uneven_times(n, 0.1), e = noise(n, seed);
      Series y;
      for (std::size_t i = 0; i < n; ++i) y.push_back(std::sin(2 * t[i]) + 0.05 * e[i]);
      const Series s = slopes(t, y), dense = Dense{t, y}.best_slopes();
      for (std::size_t i = 0; i < n; ++i) {
        INFO(n << " " << seed << " " << i << ": " << s[i] << " " << dense[i]);
        CHECK(std::abs(s[i] - dense[i]) < 1e-4);  // the parameters are 0.03 % apart at most
      }
    }
}

TEST_CASE("smoothing_spline: a straight line has its slope, on uneven times", "[signal]") {
  const Series t = uneven_times(200);
  Series y;
  for (const double time : t) y.push_back(3 - 2 * time);
  for (const double s : slopes(t, y)) CHECK(std::abs(s + 2) < 1e-10);
}

TEST_CASE(
    "smoothing_spline: without noise it follows the curve; second order, first at the ends, where "
    "it does not bend",
    "[signal]") {
  double inside = 0, ends = 0;
  for (const std::size_t n : {100u, 200u}) {
    Series t = even_times(n, 4.0 / static_cast<double>(n)), y;
    for (const double time : t) y.push_back(std::sin(time + 1));
    const auto s = slopes(t, y);
    double now = 0;
    for (std::size_t i = n / 4; i < 3 * n / 4; ++i)
      now = std::max(now, std::abs(s[i] - std::cos(t[i] + 1)));
    const double end = std::abs(s[0] - std::cos(1.0));
    if (inside > 0) CHECK(now < inside / 3.5);
    if (ends > 0) CHECK(std::abs(ends / end - 2) < 0.3);
    inside = now, ends = end;
  }
}

TEST_CASE("smoothing_spline: white noise: far better than differences", "[signal]") {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
    const Series t = even_times(200), e = noise(200, seed);
    Series y;
    for (std::size_t i = 0; i < t.size(); ++i)
      y.push_back(0.5 * t[i] - 0.03 * t[i] * t[i] + 0.001 * e[i]);
    const auto s = slopes(t, y);
    double sum = 0;
    for (std::size_t i = 0; i < t.size(); ++i) sum += std::pow(s[i] - 0.5 + 0.06 * t[i], 2) / 200;
    CHECK(std::sqrt(sum) < 0.004);  // central differences: 0.018
  }
}

TEST_CASE(
    "smoothing_spline: in no row next to no smoothing, not where the noise of neighbours is "
    "bound either",
    "[signal]") {
  const std::size_t n = 100;
  const Series t = even_times(n);
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const Series e = noise(n + 2, seed);
    Series white, bound;
    for (std::size_t i = 0; i < n; ++i) {
      const double line = 0.5 * t[i] - 0.03 * t[i] * t[i];
      white.push_back(line + 0.001 * e[i + 1]);
      bound.push_back(line + 0.001 * (e[i + 2] - e[i]));  // as after a central difference
    }
    for (const Series& y : {white, bound}) {
      const auto s = slopes(t, y), raw = through(*central_derivative(), t, y);
      double sum = 0, rough = 0;
      for (std::size_t i = 5; i + 5 < n; ++i)
        sum += std::pow(s[i] - 0.5 + 0.06 * t[i], 2),
            rough += std::pow(raw[i] - 0.5 + 0.06 * t[i], 2);
      INFO(seed << (y == bound ? " bound: " : " white: ") << std::sqrt(sum / rough));
      CHECK(sum < 0.25 * rough);
    }
  }
}

TEST_CASE(
    "smoothing_spline: time reversed, slopes change their sign; the scale of time divides them",
    "[signal]") {
  const Series t = uneven_times(60), y = noise(60, 5);
  const auto s = slopes(t, y), back = backwards(slopes(backwards(t, -1), backwards(y)), -1);
  Series slow = t;
  for (double& time : slow) time *= 1024;
  const auto slower = slopes(slow, y);
  for (std::size_t i = 0; i < t.size(); ++i) {
    CHECK(std::abs(s[i] - back[i]) <
          1e-3 * (1 + std::abs(s[i])));  // the search for the parameter rounds otherwise
    CHECK(std::abs(s[i] - 1024 * slower[i]) < 1e-9 * (1 + std::abs(s[i])));
  }
}

TEST_CASE("smoothing_spline: few samples, and many", "[signal]") {
  CHECK(slopes({}, {}).empty());
  CHECK_THROWS_AS(slopes({1}, {2}), Error);
  CHECK(slopes({1, 3}, {5, 4}) == Series{-0.5, -0.5});
  CHECK(slopes({0, 1, 2}, {0, 1, 2}) == Series{1, 1, 1});
  const std::size_t n = 100000;  // O(n): a second or so; anything else would not come to an end
  const Series t = even_times(n), e = noise(n, 7);
  Series y;
  for (std::size_t i = 0; i < n; ++i) y.push_back(std::sin(t[i] / 100) + 0.01 * e[i]);
  double worst = 0;
  const auto s = slopes(t, y);
  for (std::size_t i = 0; i < n; ++i)
    worst = std::max(worst, std::abs(s[i] - std::cos(t[i] / 100) / 100));
  CHECK(worst < 0.01);
}

TEST_CASE("spline: the size of the readings changes nothing but the size of the slopes",
          "[signal]") {
  const Series t = uneven_times(120), e = noise(120, 3);
  Series y;
  for (std::size_t i = 0; i < t.size(); ++i) y.push_back(std::sin(t[i]) + 0.05 * e[i]);
  const Series expected = slopes(t, y);
  for (const int power : {-900, -664, -100, 1, 100, 664, 1000}) {  // 664: 1e200
    Series scaled;
    for (const double value : y) scaled.push_back(std::ldexp(value, power));
    Series found = slopes(t, scaled);
    for (double& value : found) value = std::ldexp(value, -power);
    INFO("2^" << power);
    CHECK(found == expected);
  }
  CHECK(slopes(t, Series(t.size(), 0)) == Series(t.size(), 0));
}
