// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_squares/minimise.h"

#include "base/error.h"
#include "unit/catch.h"
#include "unit/fit/simulated.h"
#include "unit/least_squares/systems.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace rolling;
using systems::line_through, systems::one_run;

TEST_CASE("minimise_robust: a mean that outliers do not move, by hand", "[fit]") {
  // Of -2 -1 0 1 2 and 100: the last counts nothing. Bisquare is even, so the mean of the five is
  // their centre, 0.
  const std::vector<double> y{-2, -1, 0, 1, 2, 100};
  const System mean = one_run(
      6, 1, [&](const std::vector<double>& x, std::vector<double>& f, std::vector<double>& J) {
        for (std::size_t i = 0; i < 6; ++i) f[i] = x[0] - y[i], J[i] = 1;
      });
  const auto m = minimise_robust(mean, {{10}});
  CHECK(std::abs(m.theta[0]) < 1e-8);
  CHECK(m.f[5] == 0);
  CHECK(std::abs(m.f[0] + m.f[4]) < 1e-7);
  CHECK(m.f[0] > m.f[1]);
  CHECK(std::abs(std::pow(m.R.lengths()[0], 2) - 6) < 1e-12);  // J is not weighted
}

TEST_CASE(
    "minimise_robust: the pseudo-residuals are orthogonal to J, where the rows are not "
    "symmetric",
    "[fit]") {
  // The estimating equation, sum_i psi(r_i/s) J_i = 0: it names neither the scale nor the weights
  const std::vector<double> t{0, 1, 2, 3, 4, 5, 6, 7}, y{0, 1.2, 1.9, 3.8, 4.1, 4.2, 6.9, 50};
  const System line = line_through(t, y);
  const auto m = minimise_robust(line, {{0, 0}});
  const auto weight = [&](std::size_t i) {
    return m.f[i] / (m.theta[0] + m.theta[1] * t[i] - y[i]);
  };
  double f = 0, tf = 0;
  for (std::size_t i = 0; i < 8; ++i) f += m.f[i], tf += t[i] * m.f[i];
  CHECK(std::abs(f) < 1e-8);
  CHECK(std::abs(tf) < 1e-8);
  CHECK(weight(7) == 0);
  CHECK(weight(5) < weight(1));
}

// Huber 1981, section 7.6: the pseudo-residuals are psi(r/s) K / mean(psi'), K = 1 + p/n var(psi')
// / mean(psi')^2. The scale s and the factor follow from two of them: sqrt(f/r) is linear in r^2.
TEST_CASE("minimise_robust: the pseudo-residuals of a short row are corrected for p/n", "[fit]") {
  const std::vector<double> t{0, 1, 2, 3, 4, 5, 6, 7}, y{0, 1.2, 1.9, 3.8, 4.1, 4.2, 6.9, 50};
  const System line = line_through(t, y);
  const auto m = minimise_robust(line, {{0, 0}});
  const auto r2 = [&](std::size_t i) { return std::pow(m.theta[0] + m.theta[1] * t[i] - y[i], 2); };
  const auto root = [&](std::size_t i) { return std::sqrt(std::sqrt(m.f[i] * m.f[i] / r2(i))); };
  const double slope = (root(5) - root(1)) / (r2(5) - r2(1)), top = root(1) - slope * r2(1);
  double mean = 0, squares = 0;
  for (std::size_t i = 0; i < 7; ++i) {  // the eighth counts nothing
    const double u2 = -slope / top * r2(i), by = (1 - u2) * (1 - 5 * u2);
    mean += by / 8, squares += by * by / 8;
  }
  const double K = 1 + 2. / 8 * (squares - mean * mean) / (mean * mean);
  CHECK(K > 1.02);
  CHECK(std::abs(top * top * mean / K - 1) < 1e-9);
}

TEST_CASE("minimise_robust: every start leads to the same numbers", "[fit]") {
  simulated::Noise noise(18);
  for (int run = 0; run < 100; ++run) {
    constexpr std::size_t n = 40;
    std::vector<double> t, y;
    for (std::size_t i = 0; i < n; ++i)
      t.push_back(static_cast<double>(i) / n), y.push_back(t.back() + noise(i % 5 ? 0.1 : 1));
    const System line = line_through(t, y);
    const auto one = minimise_robust(line, {{0, 0}}), other = minimise_robust(line, {{3, -5}});
    for (std::size_t j = 0; j < 2; ++j) CHECK(std::abs(one.theta[j] - other.theta[j]) < 1e-7);
    CHECK(std::abs(one.rss / other.rss - 1) < 1e-6);
  }
}

// In some of them the median goes to and fro between two rows.
TEST_CASE("minimise_robust: short rows converge", "[fit]") {
  for (unsigned seed = 0; seed < 200; ++seed) {
    simulated::Noise noise(seed);
    std::vector<double> t, y;
    for (int i = 0; i < 10; ++i) t.push_back(i), y.push_back(i + noise(i % 5 ? 0.1 : 1));
    CHECK_NOTHROW(minimise_robust(line_through(t, y), {{0, 0}}));
  }
}

TEST_CASE("minimise_robust: without outliers a line with its classical errors, nearly", "[fit]") {
  simulated::Noise noise(17);
  constexpr std::size_t n = 4000;
  std::vector<double> t, y;
  for (std::size_t i = 0; i < n; ++i)
    t.push_back(static_cast<double>(i) / n), y.push_back(1 + 2 * t.back() + noise(0.1));
  const System line = line_through(t, y);
  const auto plain = minimise(line, {0, 0}), robust = minimise_robust(line, {{0, 0}});
  CHECK(std::abs(robust.theta[1] - 2) < 0.02);
  CHECK(std::abs(robust.rss / plain.rss - 1 / 0.95) <
        0.02);  // the efficiency that 4.685 is made for
}

// Of a line, half of whose points less one are outliers that lie on another line: squares and
// Huber's loss are drawn to them, the more so as they lie at one end.
TEST_CASE("minimise_robust: as many outliers as can be told, at one end, do not move a line",
          "[fit]") {
  simulated::Noise noise(21);
  for (int run = 0; run < 20; ++run) {
    constexpr std::size_t n = 20, outliers = 8;
    std::vector<double> t, y, good_t, good_y;
    for (std::size_t i = 0; i < n; ++i) {
      t.push_back(static_cast<double>(i));
      y.push_back(1 + 2 * t.back() + noise(0.01));
      if (i + outliers < n) good_t.push_back(t.back()), good_y.push_back(y.back());
      else y.back() = 70 - 3 * t.back() + noise(0.01);
    }
    const auto m = minimise_robust(line_through(t, y), {{0, 0}});
    const auto alone = minimise(line_through(good_t, good_y), {0, 0});
    CHECK(std::abs(m.theta[0] - alone.theta[0]) < 0.01);  // of errors of 0.006 and 0.001
    CHECK(std::abs(m.theta[1] - alone.theta[1]) < 0.002);
    for (std::size_t i = n - outliers; i < n; ++i) CHECK(m.f[i] == 0);
  }
}

TEST_CASE("minimise_robust: where most rows lie on one line, it is that line", "[fit]") {
  const std::vector<double> t{0, 1, 2, 3, 4, 5, 6, 7, 8}, y{1, 2, 3, 4, 5, 6, 70, 80, 95};
  const auto m = minimise_robust(line_through(t, y), {{0, 0}});
  CHECK(m.theta == std::vector<double>{1, 1});
  CHECK(m.rss == 0);
  CHECK(std::abs(std::pow(m.R.lengths()[0], 2) - 9) < 1e-12);  // J is not weighted
}

TEST_CASE("minimise_robust: a start without finite values is refused, or another one is taken",
          "[fit]") {
  const std::vector<double> t{0, 1, 2, 3, 4}, y{0, 1, 2.1, 3, 4};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const System line = line_through(t, y);
  CHECK_THROWS_AS(minimise_robust(line, {{nan, 0}}), Error);
  CHECK(std::abs(minimise_robust(line, {{nan, 0}, {0, 0}}).theta[1] - 1) < 0.1);
}

TEST_CASE("minimise_robust: a run of a hundred times the noise is no outlier as a whole", "[fit]") {
  // Two levels, of noise 0.01 and 1.
  constexpr std::size_t n = 40;
  simulated::Noise noise(5);
  std::vector<double> y;
  for (std::size_t i = 0; i < 2 * n; ++i) y.push_back(i < n ? noise(0.01) : 3 + noise(1));
  y[7] = 30, y[n + 7] = 3.3;
  const System levels{{n, n}, 1, 0, [&](const std::vector<double>& x, const TakeRows& take) {
                        for (std::size_t run : {0U, 1U}) {
                          std::vector<double> f, J(n, 1);
                          for (std::size_t i = 0; i < n; ++i) f.push_back(x[run] - y[run * n + i]);
                          take(run, f, J);
                        }
                      }};
  const Minimum m = minimise_robust(levels, {{0, 0}});
  CHECK(std::abs(m.theta[0]) < 0.006);
  CHECK(std::abs(m.theta[1] - 3) < 0.6);
  CHECK(m.f[7] == 0);
  CHECK(m.f[n + 7] != 0);
  CHECK(std::ranges::count(m.f, 0) < 5);
}

TEST_CASE("minimise_robust: runs at rest do not make the noise of the others smaller", "[fit]") {
  // Levels of 40 readings: the first with noise 1, the others constant but for rounding.
  constexpr std::size_t n = 40;
  simulated::Noise noise(6);
  std::vector<double> y;
  for (std::size_t i = 0; i < n; ++i) y.push_back(noise(1));
  y[7] = 4, y[21] = 6, y[30] = 5;
  const auto level_beside = [&](std::size_t others) {
    const System levels{std::vector<std::size_t>(1 + others, n), 1, 0,
                        [&, others](const std::vector<double>& x, const TakeRows& take) {
      for (std::size_t run = 0; run <= others; ++run) {
        std::vector<double> f(n, x[run] + (run % 2 == 0 ? 0 : 1e-17)), J(n, 1);
        if (run == 0)
          for (std::size_t i = 0; i < n; ++i) f[i] = x[run] - y[i];
        take(run, f, J);
      }
                        }};
    return minimise_robust(levels, {std::vector<double>(1 + others)}).theta[0];
  };
  for (const std::size_t others : {1U, 9U})
    CHECK(std::abs(level_beside(others) - level_beside(0)) < 1e-6);
}
