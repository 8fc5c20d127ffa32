#include "noise/whitener.h"

#include "base/error.h"
#include "noise/noise.h"
#include "noise/response.h"
#include "unit/fit/simulated.h"
#include "unit/noise/dense.h"
#include "unit/catch.h"

using namespace rolling;

TEST_CASE("whitener: the floor is white noise of its own", "[fit]") {
  const BandMatrix E = probe(simulated::smooth_v(3), simulated::times(6));
  const Whitener whitener(Covariance(E), 0.5);
  // C = E E^T + 0.25 I, so (W x).(W x) = x^T C^-1 x; for x = C y that is y^T C y
  const auto e = dense(E, 6);
  std::vector<double> y{1, -2, 0.5, 3, -1, 2}, x(6, 0);
  double expected = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < 6; ++k) {
      double c = i == k ? 0.25 : 0;
      for (std::size_t j = 0; j < 6; ++j) c += e[i * 6 + j] * e[k * 6 + j];
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
    "whitener: floors of every size leave white noise of size one, and say by how much a volume "
    "shrinks and what is left of E",
    "[fit]") {
  constexpr std::size_t n = 40;
  const auto t = simulated::times(n);
  const FilterMatrix E = FilterMatrix(probe(simulated::smooth_v(7), t))
                             .then(probe(simulated::differentiate("v", "a"), t));
  const auto dense_E = dense(E, n);
  double largest = 0;
  for (double norm : row_norms(E)) largest = std::max(largest, norm);
  for (double share : {1e-5, 1e-4, 1e-3, 1e-2, 1.0, 1e3}) {
    // Cholesky's method loses as many digits as the condition number of C has.
    const double floor = share * largest, close = 1e-14 * (10 + 1 / (share * share));
    const Whitener whitener(Covariance(E), floor);
    std::vector<std::vector<double>> columns;  // of R^-T [E, floor I]
    for (std::size_t j = 0; j < 2 * n; ++j) {
      std::vector<double> x(n, 0);
      for (std::size_t i = 0; i < n; ++i)
        x[i] = j < n ? dense_E[i * n + j] : i == j - n ? floor : 0;
      whitener.apply(x);
      columns.push_back(std::move(x));
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        double sum = 0;
        for (const auto& x : columns) sum += x[i] * x[k];
        CHECK(std::abs(sum - (i == k)) < close);
      }
    double of_E = 0;  // tr W E E^T W^T
    for (std::size_t j = 0; j < n; ++j)
      for (double x : columns[j]) of_E += x * x;
    CHECK(std::abs(whitener.trace() - of_E) < n * close);
    // Elimination of the dense C, in long double: its pivots are the squares of R's.
    std::vector<long double> C(n * n, 0);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        C[i * n + k] = i == k ? static_cast<long double>(floor) * floor : 0;
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

// The last row is the mean of the speeds, which reaches over the whole run.
TEST_CASE("whitener: a last row that borders the band is whitened like the others", "[fit]") {
  constexpr std::size_t n = 30;
  const auto t = simulated::times(n);
  // Derivatives do not see a mean over all records; they do see this one.
  std::vector<double> mean(n);
  for (std::size_t i = 0; i < n; ++i) mean[i] = (i < n / 3 ? 2.0 : 0.5) / n;
  const FilterMatrix E = FilterMatrix(probe(simulated::smooth_v(5), t))
                             .then(probe(simulated::differentiate("v", "a"), t))
                             .with_last_row(mean);
  const double floor = 0.3;
  const Whitener whitener(Covariance(E), floor);
  const auto dense_E = dense(E, n);
  std::vector<std::vector<double>> columns;  // of R^-T [E, floor I], no floor in the last row
  double of_E = 0;
  for (std::size_t j = 0; j < 2 * n; ++j) {
    std::vector<double> x(n + 1, 0);
    for (std::size_t i = 0; i <= n; ++i) x[i] = j < n ? dense_E[i * n + j] : i == j - n ? floor : 0;
    whitener.apply(x);
    for (double z : x) of_E += j < n ? z * z : 0;
    columns.push_back(std::move(x));
  }
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t k = 0; k <= n; ++k) {
      double sum = 0;
      for (const auto& x : columns) sum += x[i] * x[k];
      CHECK(std::abs(sum - (i == k)) < 1e-9);
    }
  CHECK(std::abs(whitener.trace() - of_E) < 1e-9);
  // R^-1 is the transposed of R^-T: (R^-1 x) y = x (R^-T y).
  std::vector<double> x, y;
  for (std::size_t i = 0; i <= n; ++i) {
    x.push_back(std::sin(3.0 * static_cast<double>(i)));
    y.push_back(std::cos(5.0 * static_cast<double>(i)));
  }
  auto Rx = x, Ry = y;
  whitener.apply_transposed(Rx);
  whitener.apply(Ry);
  double left = 0, right = 0;
  for (std::size_t i = 0; i <= n; ++i) left += Rx[i] * y[i], right += x[i] * Ry[i];
  CHECK(std::abs(left - right) < 1e-10);
}

TEST_CASE("whitener: a column that the filters leave without noise is refused", "[fit]") {
  BandMatrix E;
  E.append(0, std::vector<double>{0, 0});
  E.append(0, std::vector<double>{0, 0});
  CHECK_THROWS_AS(Whitener(Covariance(E), 0), Error);
  // The mean of a column without noise.
  CHECK_THROWS_AS(Whitener(Covariance(FilterMatrix(E).with_last_row({0, 0})), 0.1), Error);
}
