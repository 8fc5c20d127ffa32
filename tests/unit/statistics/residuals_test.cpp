// SPDX-License-Identifier: GPL-3.0-or-later
#include "statistics/residuals.h"

#include <algorithm>
#include <cmath>

#include "unit/catch.h"
#include "unit/fit/simulated.h"

using namespace rolling;

TEST_CASE("residuals: Ljung-Box tells white residuals from correlated ones", "[statistics]") {
  simulated::Noise noise(3);
  std::vector<double> white, smooth;
  for (int i = 0; i < 200; ++i) white.push_back(noise(1));
  smooth = simulated::mean(white, 5);
  const std::size_t one[] = {200}, two[] = {100, 100};
  const LagSums taken = taken_by_few(1);
  CHECK(ljung_box(white, taken, one) > 0.01);
  CHECK(ljung_box(white, taken, two) > 0.01);
  CHECK(ljung_box(smooth, taken, one) < 1e-6);
}

// The share of white noise with a p up to each limit is that limit, within four of its standard
// deviations, for one lag and for ten.
TEST_CASE("residuals: the p of white noise is uniform", "[statistics]") {
  simulated::Noise noise(11);
  for (const std::size_t size : {15u, 1000u}) {
    const std::size_t runs[] = {size};
    constexpr int trials = 2000;
    std::vector<double> p;
    for (int trial = 0; trial < trials; ++trial) {
      std::vector<double> white;
      for (std::size_t i = 0; i < size; ++i) white.push_back(noise(1));
      p.push_back(ljung_box(white, {}, runs));
    }
    for (const double limit : {0.02, 0.1, 0.3, 0.5, 0.8}) {
      const auto below =
          static_cast<double>(std::ranges::count_if(p, [&](double x) { return x <= limit; }));
      CAPTURE(size, limit, below);
      CHECK(std::abs(below - limit * trials) < 4 * std::sqrt(trials * limit * (1 - limit)));
    }
  }
}

// Of 1000 with a chance of 1 to 2 %, 40 or more come in 1 of 10,000.
TEST_CASE("residuals: white noise of another size in one run is not correlated", "[statistics]") {
  simulated::Noise noise(5);
  const std::size_t runs[] = {60, 60, 60, 60};
  int correlated = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<double> white;
    for (int i = 0; i < 240; ++i) white.push_back(noise(i < 180 ? 1 : 10));
    correlated += ljung_box(white, {}, runs) < 0.01;
  }
  CHECK(correlated < 40);
}

TEST_CASE("residuals: white noise that falls along the run is not correlated", "[statistics]") {
  simulated::Noise noise(7);
  const std::size_t runs[] = {100};
  int even = 0, uneven = 0, told = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<double> white, correlated;
    double x = 0;
    for (int i = 0; i < 100; ++i) {
      const double size = std::pow(10, -i / 99.0), e = noise(1);
      x = 0.5 * x + e;
      white.push_back(size * e);
      correlated.push_back(size * x);
    }
    even += ljung_box(white, {}, runs) < 0.01;
    uneven += ljung_box(white, {}, runs, true) < 0.01;
    told += ljung_box(correlated, {}, runs, true) < 0.01;
  }
  CHECK(even > 80);
  CHECK(uneven < 30);
  CHECK(told > 600);
}

TEST_CASE("residuals: Newey-West by hand", "[statistics]") {
  // r = -1/4 and AR = (4 r + 1)/(4 - 1 - 2) = 0: nothing to whiten. rho = -1/4, alpha = 64/225,
  // width = ceil(1.1447 cbrt(4 alpha)) = 2; products one apart sum to -1, two apart to 0: 4 + 2
  // (2/3) (-1).
  const std::size_t four[] = {4}, five[] = {5};
  const std::vector<double> u{1, 1, -1, 1};
  CHECK(std::abs(newey_west({u}, 1, u, four)[0] - 8.0 / 3) < 1e-12);
  // r = 0, AR = 1/2: whitened sqrt(3)/2, 1/2, -3/2, -1/2, 3/2 with squares 23/4, products sqrt(3)/4
  // - 3/4, width 1.
  const std::vector<double> w{1, 1, -1, -1, 1};
  CHECK(std::abs(newey_west({w}, 1, w, five)[0] - 4 * (23.0 / 4 + std::sqrt(3) / 4 - 3.0 / 4)) <
        1e-12);
}

TEST_CASE(
    "residuals: Breusch-Pagan notices noise that grows, or differs between runs, and 1 % of even "
    "noise",
    "[statistics]") {
  simulated::Noise noise(3);
  int even = 0, even_ten = 0, growing = 0, differing = 0;
  for (int k = 0; k < 1000; ++k) {
    std::vector<double> e, g;
    for (int i = 0; i < 100; ++i) {
      e.push_back(noise(1));
      g.push_back(noise(1 + 0.06 * i));
    }
    const std::size_t runs[] = {60, 40}, one[] = {100};
    const std::vector<std::size_t> ten(10, 10);
    even += breusch_pagan(e, runs) <= 0.01;
    even_ten += breusch_pagan(e, ten) <= 0.01;
    growing += breusch_pagan(g, one) <= 0.01;
    for (std::size_t i = 60; i < 100; ++i) e[i] *= 3;
    differing += breusch_pagan(e, runs) <= 0.01;
  }
  CHECK(even <= 22);  // more of 1000 at 1 % by chance in 0.04 %
  CHECK(even_ten <= 22);
  CHECK(growing >= 950);
  CHECK(differing >= 950);
}

// In a run that is shorter than twice the bandwidth the width is half the run. By the definition,
// the sum over all pairs.
TEST_CASE("residuals: Newey-West of a run that is shorter than twice the bandwidth",
          "[statistics]") {
  constexpr std::size_t runs[] = {60, 9};
  std::vector<double> r;
  for (std::size_t i = 0; i < 69; ++i) {
    const double x = static_cast<double>(i);
    r.push_back(std::sin(x / 2) + 0.1 * std::sin(x * x));
  }
  const auto lag1 = [&](const std::vector<double>& x) {
    double products = 0, squares = 0;
    for (std::size_t i = 0; i < 69; ++i) {
      squares += x[i] * x[i];
      if (i != 59 && i != 68) products += x[i] * x[i + 1];
    }
    return products / squares;
  };
  constexpr double n = 69, p = 2;
  const double AR = (n * lag1(r) + p) / (n - p - 2);
  std::vector<double> u = r;
  for (std::size_t i = 0; i < 69; ++i)
    u[i] = i == 0 || i == 60 ? std::sqrt(1 - AR * AR) * r[i] : r[i] - AR * r[i - 1];
  const double rho = lag1(u),
               width = std::ceil(1.1447 * std::cbrt(4 * std::pow(rho / (1 - rho * rho), 2) * n));
  REQUIRE(width > 4);
  double sum = 0;
  for (int i = 60; i < 69; ++i)
    for (int j = 60; j < 69; ++j)
      if (const int lag = std::abs(i - j); lag <= 4)
        sum += (1 - lag / 5.0) * u[static_cast<std::size_t>(i)] * u[static_cast<std::size_t>(j)];
  CHECK(newey_west({r}, 2, r, runs)[1] == Approx(sum / ((1 - AR) * (1 - AR))).epsilon(1e-12));
}
