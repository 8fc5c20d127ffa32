#include "noise/response.h"

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
    const FilterChain chain{simulated::differentiate("x", "v"), simulated::smooth_v(7),
                            simulated::differentiate("v", "a")};
    const auto response = response_of(chain, t);
    CHECK(response.source == "x");
    std::vector<double> x;
    for (std::size_t i = 0; i < n; ++i) x.push_back(std::sin(3.7 * static_cast<double>(i * i)));
    const auto v = chain[1].apply(t, chain[0].apply(t, x)), a = chain[2].apply(t, v);
    for (std::size_t i = 0; i < n; ++i) {
      CHECK(std::abs(response.of.at("v").times(x)[i] - v[i]) < 1e-12);
      CHECK(std::abs(response.of.at("a").times(x)[i] - a[i]) < 1e-11);
    }
  }
}

TEST_CASE("response: noise from two raw columns is refused", "[fit]") {
  CHECK_THROWS_AS(response_of({simulated::smooth_v(3), simulated::differentiate("x", "w")},
                              simulated::times(9)),
                  Error);
}

TEST_CASE(
    "response: of records that were cut after a filter, the first and the last are interior ones",
    "[fit]") {
  const auto t = simulated::times(40);
  simulated::Noise noise(2);
  std::vector<double> x;
  for (std::size_t i = 0; i < t.size(); ++i) x.push_back(noise(1));
  FilterChain chain{simulated::smooth_v(5), simulated::differentiate("v", "a"),
                    simulated::smooth_v(3)};
  chain[2].from = chain[2].to = "a";
  chain[0].from = "v";
  chain[1].cut_begin = chain[2].cut_begin = chain[2].cut_end = true;
  // What the chain does with records 10 to 29, the second cut after a first one at 8.
  const auto v = chain[0].apply(t, x);
  const auto from8 = [](const std::vector<double>& y) {
    return std::vector<double>(y.begin() + 8, y.end());
  };
  const auto a = chain[1].apply(from8(t), from8(v));
  const std::vector<double> a_cut(a.begin() + 2, a.begin() + 22),
      t_cut(t.begin() + 10, t.begin() + 30);
  const auto smooth = chain[2].apply(t_cut, a_cut);

  const auto response = response_of(chain, t_cut);
  REQUIRE(response.t.size() == 26);  // both filters before the last cut reach 2 + 1 records further
  for (std::size_t i = 0; i < 26; ++i) CHECK(std::abs(response.t[i] - t[i + 7]) < 1e-12);
  const std::vector<double> raw(x.begin() + 7, x.begin() + 33);
  REQUIRE(response.of.at("a").rows() == 20);
  for (std::size_t i = 0; i < 20; ++i)
    CHECK(std::abs(response.of.at("a").times(raw)[i] - smooth[i]) < 1e-12);
  for (std::size_t i = 0; i < 20; ++i)
    CHECK(std::abs(response.of.at("v").times(raw)[i] - v[i + 10]) < 1e-12);
  // Two records are enough to tell the times of those that were cut away.
  const auto brief = response_of(chain, simulated::times(2));
  CHECK(brief.t.size() == 8);
  CHECK(brief.of.at("a").rows() == 2);
}

TEST_CASE("response: a filter that does the same everywhere is probed in a short run", "[fit]") {
  LinearFilter mean = simulated::smooth_v(5);
  mean.shift_invariant = true;
  for (std::size_t n : {4u, 14u, 15u, 16u, 17u, 40u}) {
    const auto t = simulated::times(n);
    CHECK(dense(probe(mean, t), n) == dense(probe(simulated::smooth_v(5), t), n));
  }
}

TEST_CASE("response: a pass through the filters is the product with their matrix", "[fit]") {
  constexpr std::size_t n = 600;
  const auto t = simulated::times(n);
  const FilterMatrix H = FilterMatrix::identity(n)
                             .then(probe(simulated::smooth_v(9), t))
                             .then(probe(simulated::differentiate("v", "a"), t))
                             .of_rows(std::vector<std::size_t>{0, 1, 5, 300, 301, 598, 599});
  std::vector<double> x, y;
  for (std::size_t i = 0; i < n; ++i) x.push_back(std::sin(0.3 * static_cast<double>(i * i)));
  const auto Hx = H.times(x), matrix = dense(H, n);
  REQUIRE(Hx.size() == 7);
  for (std::size_t i = 0; i < Hx.size(); ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += matrix[i * n + k] * x[k];
    CHECK(std::abs(Hx[i] - sum) < 1e-11);
    y.push_back(std::cos(static_cast<double>(i)));
  }
  const auto Hty = H.transposed_times(y);
  for (std::size_t k = 0; k < n; ++k) {
    double sum = 0;
    for (std::size_t i = 0; i < y.size(); ++i) sum += matrix[i * n + k] * y[i];
    CHECK(std::abs(Hty[k] - sum) < 1e-11);
  }
}

TEST_CASE("response: a filter that does not give a value for each record is refused", "[fit]") {
  const LinearFilter short_one{"v", "v", 1, [](std::span<const double>, std::span<const double> y) {
                                 return std::vector<double>(y.begin() + 1, y.end());
                               }};
  CHECK_THROWS_AS(probe(short_one, simulated::times(9)), Error);
}
