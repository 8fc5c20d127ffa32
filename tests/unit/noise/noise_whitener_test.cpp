// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/noise.h"

#include "base/matrix.h"
#include "base/error.h"
#include "noise/response.h"
#include "unit/fit/simulated.h"
#include "unit/noise/dense.h"
#include "unit/catch.h"

#include <cmath>
#include <limits>
#include <numbers>

using namespace rolling;

TEST_CASE("whitener: a share of white noise is noise of its own", "[fit]") {
  const BandMatrix E = probe(simulated::smooth_v(3), simulated::times(6));
  const Whitener whitener(Covariance(E), 0.5);
  // C = E E^T + 0.25 diag(E E^T), so (W x).(W x) = x^T C^-1 x; for x = C y that is y^T C y
  const auto e = dense(E);
  std::vector<double> y{1, -2, 0.5, 3, -1, 2}, x(6, 0);
  double expected = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < 6; ++k) {
      double c = 0;
      for (std::size_t j = 0; j < 6; ++j) c += e[i * 6 + j] * e[k * 6 + j];
      if (i == k) c *= 1.25;
      x[i] += c * y[k];
    }
    expected += y[i] * x[i];
  }
  auto z = x;
  whitener.apply(z);
  double sum = 0;
  for (double s : z) sum += s * s;
  CHECK(std::abs(sum / expected - 1) < 1e-13);
  whitener.apply_transposed(z);  // R^-1 R^-T x = C^-1 x = y
  for (std::size_t i = 0; i < 6; ++i) CHECK(std::abs(z[i] - y[i]) < 1e-12);
}

TEST_CASE(
    "whitener: shares of every size leave white noise of size one, and say by how much a volume "
    "shrinks and what is left of E",
    "[fit]") {
  constexpr std::size_t n = 40;
  const auto t = simulated::times(n);
  const BandMatrix E = probe(simulated::differentiate(Quantity::v, Quantity::a), t) *
                       probe(simulated::smooth_v(7), t);
  const auto dense_E = dense(E);
  const Covariance EE(E);
  const double width = static_cast<double>(EE.band),
               least = width * width * std::numeric_limits<double>::epsilon();
  for (double share : {1e-5, 1e-4, 1e-3, 1e-2, 1.0, 1e3}) {
    // Cholesky's method loses as many digits as the condition number of C has.
    const double close = 1e-14 * (10 + 1 / (share * share));
    const auto white = [&](std::size_t i) {
      return std::sqrt((share * share + least) * EE.rows[i * EE.band]);
    };
    const Whitener whitener(EE, share);
    std::vector<std::vector<double>> columns;  // of R^-T [E, the white noise]
    for (std::size_t j = 0; j < 2 * n; ++j) {
      std::vector<double> x(n, 0);
      for (std::size_t i = 0; i < n; ++i)
        x[i] = j < n ? dense_E[i * n + j] : i == j - n ? white(i) : 0;
      whitener.apply(x);
      columns.push_back(std::move(x));
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        double sum = 0;
        for (const auto& x : columns) sum += x[i] * x[k];
        CHECK(std::abs(sum - (i == k)) < close);
      }
    // Elimination of the dense C, in long double: its pivots are the squares of R's.
    std::vector<long double> C(n * n, 0);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        C[i * n + k] = i == k ? static_cast<long double>(white(i)) * white(i) : 0;
        for (std::size_t j = 0; j < n; ++j)
          C[i * n + k] += static_cast<long double>(dense_E[i * n + j]) * dense_E[k * n + j];
      }
    long double log_size = 0;
    for (std::size_t k = 0; k < n; ++k) {
      log_size += std::log(C[k * n + k]) / 2;
      for (std::size_t i = k + 1; i < n; ++i)
        for (std::size_t j = n; j-- > k;)
          C[i * n + j] -= C[i * n + k] / C[k * n + k] * C[k * n + j];  // column k last
    }
    CHECK(std::abs(whitener.log_size() - static_cast<double>(log_size)) < n * close);
  }
}

// The residuals are differences of sources, which tell all of the sources but their mean. So a slow
// model r of the sources counts as if the sources themselves were fitted beside an unknown
// constant: |W J|^2 = |r - mean of r|^2 with J = E r, in closed form. Of the slowest motion the
// differences hold 1/n of the size that those of white noise have: a share of white noise of 1e-4
// would take half of |W J|^2 at n = 20000.
TEST_CASE("whitener: differences of a slow motion weigh as much as the motion itself", "[fit]") {
  for (const std::size_t n : {10U, 1000U, 100000U}) {
    BandMatrix E(n);
    for (std::size_t i = 0; i + 1 < n; ++i) E.append(i, std::vector<double>{-1, 1});
    std::vector<double> J;
    double mean = 0, squares = 0;
    const auto r = [n](std::size_t i) {
      return std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(n - 1));
    };
    for (std::size_t i = 0; i < n; ++i) mean += r(i) / static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) squares += (r(i) - mean) * (r(i) - mean);
    for (std::size_t i = 0; i + 1 < n; ++i) J.push_back(r(i + 1) - r(i));
    Whitener(Covariance(E), 0).apply(J);
    CAPTURE(n);
    CHECK(std::abs(dot(J, J) / squares - 1) < 1e-5);
  }
}

// Filters of any width have directions without noise, where rounding alone could make a pivot
// negative.
TEST_CASE("whitener: rounding leaves every covariance of filters positive definite", "[fit]") {
  for (const std::size_t width : {1U, 5U, 11U, 31U, 201U})
    for (const std::size_t n : {60U, 1000U, 5000U}) {
      const auto t = simulated::times(n);
      const BandMatrix difference = probe(simulated::differentiate(Quantity::x, Quantity::v), t),
                       mean = probe(simulated::smooth_v(width), t);
      const BandMatrix E = mean * difference;
      for (const BandMatrix& filters : {E, mean * E, difference * E}) {
        CAPTURE(width, n);
        const Whitener whitener(Covariance(filters), 0);
        std::size_t informative = 0;
        for (std::size_t i = 0; i < n; ++i) informative += whitener.informative(i);
        CHECK(static_cast<double>(informative) >
              0.9 * static_cast<double>(n) - 2 * static_cast<double>(width));
      }
    }
}

TEST_CASE("whitener: a column that the filters leave without noise is refused", "[fit]") {
  BandMatrix E(2);
  E.append(0, std::vector<double>{0, 0});
  E.append(0, std::vector<double>{0, 0});
  CHECK_THROWS_AS(Whitener(Covariance(E), 0), Error);
}
