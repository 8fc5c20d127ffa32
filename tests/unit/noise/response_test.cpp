// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/response.h"

#include "base/matrix.h"
#include "base/error.h"
#include "unit/noise/dense.h"
#include "unit/fit/simulated.h"
#include "unit/catch.h"

using namespace rolling;

TEST_CASE(
    "response: a probed chain does to a column what the filters do, shrinking and one-sided ends "
    "included",
    "[fit]") {
  for (std::size_t n : {3u, 4u, 9u, 40u}) {
    const auto t = simulated::times(n);
    const FilterChain chain{simulated::differentiate(Quantity::x, Quantity::v),
                            simulated::smooth_v(7),
                            simulated::differentiate(Quantity::v, Quantity::a)};
    const auto response = response_of(chain, t);
    CHECK(response.source == Quantity::x);
    std::vector<double> x;
    for (std::size_t i = 0; i < n; ++i) x.push_back(std::sin(3.7 * static_cast<double>(i * i)));
    const auto v = chain[1].apply(t, chain[0].apply(t, x)), a = chain[2].apply(t, v);
    for (std::size_t i = 0; i < n; ++i) {
      CHECK(std::abs(response.of[Quantity::v]->times(x)[i] - v[i]) < 1e-12);
      CHECK(std::abs(response.of[Quantity::a]->times(x)[i] - a[i]) < 1e-11);
    }
  }
}

TEST_CASE("response: every row is found whole, as wide as it may be", "[fit]") {
  for (std::size_t reach = 0; reach < 5; ++reach)
    for (std::size_t n = 1; n < 30; ++n) {
      std::vector<double> matrix(n * n);
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t side = i < reach || i + reach >= n ? 2 * reach : reach;
        for (std::size_t j = i - std::min(i, side); j < std::min(n, i + side + 1); ++j)
          matrix[i * n + j] = static_cast<double>(1 + i * n + j);
      }
      const LinearFilter filter{Quantity::v, Quantity::v, reach, [&](auto, auto y) {
                                  std::vector<double> product;
                                  for (std::size_t i = 0; i < n; ++i)
                                    product.push_back(dot(&matrix[i * n], y.data(), n));
                                  return product;
                                }};
      std::vector<double> t;  // uneven steps: the filter is not the same everywhere
      for (std::size_t i = 0; i < n; ++i) t.push_back(static_cast<double>(i * i));
      CAPTURE(reach, n);
      CHECK(dense(probe(filter, t)) == matrix);
    }
}

TEST_CASE("response: noise from two raw columns is refused", "[fit]") {
  CHECK_THROWS_AS(
      response_of({simulated::smooth_v(3), simulated::differentiate(Quantity::x, Quantity::a)},
                  simulated::times(9)),
      Error);
}

TEST_CASE("response: a filter that does the same everywhere is probed in a short run", "[fit]") {
  LinearFilter mean = simulated::smooth_v(5);
  mean.shift_invariant = true;
  for (std::size_t n : {4u, 14u, 15u, 16u, 17u, 40u}) {
    const auto t = simulated::times(n);
    CHECK(dense(probe(mean, t)) == dense(probe(simulated::smooth_v(5), t)));
  }
}

TEST_CASE("response: of equal steps few rows are probed; a lost row changes its neighbours",
          "[fit]") {
  std::size_t probed = 0;
  const LinearFilter slopes{Quantity::x, Quantity::v, 1,
                            [&](std::span<const double> t, std::span<const double> x) {
    probed = t.size();
    std::vector<double> v(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      const std::size_t k = std::min(i + 1, x.size() - 1), j = std::max<std::size_t>(i, 1) - 1;
      v[i] = (x[k] - x[j]) / (t[k] - t[j]);
    }
    return v;
                            }};
  std::vector<double> t, x;
  for (int i = 0; i < 400; ++i) {
    t.push_back(7 + i / 25.0);
    x.push_back(std::sin(3.7 * i * i));
  }
  const auto are_the_same = [&] {
    const auto v = slopes.apply(t, x), product = probe(slopes, t).times(x);
    REQUIRE(product.size() == t.size());
    for (std::size_t i = 0; i < t.size(); ++i) CHECK(std::abs(product[i] - v[i]) < 1e-9);
  };
  are_the_same();
  CHECK(probed == 9);
  const BandMatrix H = probe(simulated::smooth_v(5), t) * probe(slopes, t);
  std::size_t repeated = 0;
  for (std::size_t i = 0; i < H.rows(); ++i) repeated += H.repeats(i);
  CHECK(repeated > t.size() / 2);
  t.erase(t.begin() + 160), x.erase(x.begin() + 160);
  are_the_same();
  CHECK(probed == t.size());
  for (std::size_t i = 0; i < t.size(); ++i)
    t[i] = 7 + static_cast<double>(i) / 25 + (i % 2 ? 1e-9 : 0);  // more than rounding
  probe(slopes, t);
  CHECK(probed == t.size());
}

TEST_CASE("response: filters one after another are the product of their matrices", "[fit]") {
  constexpr std::size_t n = 600;
  const auto t = simulated::times(n);
  const BandMatrix mean = probe(simulated::smooth_v(9), t),
                   slope = probe(simulated::differentiate(Quantity::v, Quantity::a), t);
  const std::vector<std::size_t> rows{0, 1, 5, 300, 301, 598, 599};
  const BandMatrix H = (slope * mean * BandMatrix::identity(n)).of_rows(rows);
  std::vector<double> x, y;
  for (std::size_t i = 0; i < 2 * n; ++i) x.push_back(std::sin(0.3 * static_cast<double>(i * i)));
  const auto Hx = H.times(x), matrix = dense(H), apart = slope.times(mean.times(x));
  REQUIRE(Hx.size() == 14);
  for (std::size_t i = 0; i < 14; ++i)
    CHECK(std::abs(Hx[i] - apart[i / 7 * n + rows[i % 7]]) < 1e-11);
  for (std::size_t i = 0; i < 7; ++i) y.push_back(std::cos(static_cast<double>(i)));
  const auto Hty = H.transposed_times(y);
  for (std::size_t k = 0; k < n; ++k) {
    double sum = 0;
    for (std::size_t i = 0; i < y.size(); ++i) sum += matrix[i * n + k] * y[i];
    CHECK(std::abs(Hty[k] - sum) < 1e-11);
  }
}

TEST_CASE("response: a filter that does not give a value for each row is refused", "[fit]") {
  const LinearFilter short_one{Quantity::v, Quantity::v, 1,
                               [](std::span<const double>, std::span<const double> y) {
    return std::vector<double>(y.begin() + 1, y.end());
                               }};
  CHECK_THROWS_AS(probe(short_one, simulated::times(9)), Error);
}
