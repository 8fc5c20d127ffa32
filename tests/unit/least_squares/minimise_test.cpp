// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_squares/minimise.h"

#include "base/error.h"
#include "fit/refits.h"
#include "unit/catch.h"
#include "unit/fit/simulated.h"
#include "unit/least_squares/systems.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

using namespace rolling;

using systems::line_through, systems::one_run;

TEST_CASE("minimise: Rosenbrock's valley, from the usual start", "[fit]") {
  const System valley = one_run(
      2, 2, [](const std::vector<double>& x, std::vector<double>& f, std::vector<double>& J) {
        f = {10 * (x[1] - x[0] * x[0]), 1 - x[0]};
        J = {-20 * x[0], -1, 10, 0};
      });
  const auto m = minimise(valley, {-1.2, 1});
  CHECK(std::abs(m.theta[0] - 1) < 1e-14);
  CHECK(std::abs(m.theta[1] - 1) < 1e-14);
}

TEST_CASE("minimise: a rough search along a far valley is given up", "[fit]") {
  int evaluations = 0;
  constexpr std::size_t rows = 100;
  System valley = one_run(
      rows, 2, [&](const std::vector<double>& x, std::vector<double>& f, std::vector<double>& J) {
        ++evaluations;
        f.assign(rows, 1 - x[0]);
        f[0] = 500 * (x[1] - x[0] * x[0]);
        J.assign(2 * rows, 0);
        std::fill_n(J.begin(), rows, -1);
        J[0] = -1000 * x[0];
        J[rows] = 500;
      });
  const std::vector<double> far = {-100, 1e4};
  CHECK(std::abs(minimise(valley, far).theta[0] - 1) < 1e-10);
  CHECK(evaluations > 350);
  evaluations = 0;
  valley.rough = true;
  CHECK_THROWS_AS(minimise(valley, far), Error);
  CHECK(evaluations < 350);
}

TEST_CASE("minimise: no point is evaluated twice in succession", "[fit]") {
  std::vector<std::vector<double>> points;
  const System valley = one_run(
      2, 2, [&](const std::vector<double>& x, std::vector<double>& f, std::vector<double>& J) {
        points.push_back(x);
        f = {10 * (x[1] - x[0] * x[0]), 1 - x[0]};
        J = {-20 * x[0], -1, 10, 0};
      });
  minimise(valley, {-1.2, 1});
  CHECK(points.size() > 3);
  CHECK(std::ranges::adjacent_find(points) == points.end());
}

TEST_CASE("minimise: as many rows as parameters: the root, to round-off of its size", "[fit]") {
  for (const double square : {3., 3e18, 5e18, 7e18}) {
    const System root = one_run(
        1, 1, [&](const std::vector<double>& x, std::vector<double>& f, std::vector<double>& J) {
          f = {x[0] * x[0] - square};
          J = {2 * x[0]};
        });
    CHECK(std::abs(minimise(root, {1.5 * std::sqrt(square)}).theta[0] / std::sqrt(square) - 1) <
          4e-16);
  }
}

TEST_CASE("minimise: a kink at the minimum is a minimum", "[fit]") {
  // (1 + |x|/4)^2 + (1 - x/6)^2 has the slopes -1/2 - 1/3 and 1/2 - 1/3 on the two sides of x = 0:
  // no step goes down from there
  const System kink = one_run(
      2, 1, [](const std::vector<double>& x, std::vector<double>& f, std::vector<double>& J) {
        f = {1 + std::abs(x[0]) / 4, 1 - x[0] / 6};
        J = {x[0] > 0 ? 0.25 : -0.25, -1.0 / 6};
      });
  CHECK(std::abs(minimise(kink, {0.7}).theta[0]) < 1e-6);
  // The step on either side of a steep one is more than a standard deviation.
  const System steep = one_run(
      4, 1, [](const std::vector<double>& x, std::vector<double>& f, std::vector<double>& J) {
        const double rise = 1 + 2 * std::abs(x[0]), slope = x[0] > 0 ? 2 : -2;
        f = {rise, rise, rise, 1 - x[0] / 6};
        J = {slope, slope, slope, -1.0 / 6};
      });
  CHECK(std::abs(minimise(steep, {0.7}).theta[0]) < 1e-6);
}

TEST_CASE("minimise: refuses what does not converge and what cannot be told apart", "[fit]") {
  const System runaway = one_run(
      3, 1, [](const std::vector<double>& x, std::vector<double>& f, std::vector<double>& J) {
        f = {std::exp(-x[0]), std::exp(-x[0]), 2 * std::exp(-x[0])};
        J = {-f[0], -f[1], -f[2]};
      });
  CHECK_THROWS_AS(minimise(runaway, {0}), Error);
  const System twins = one_run(
      3, 2, [](const std::vector<double>& x, std::vector<double>& f, std::vector<double>& J) {
        f = {x[0] + x[1] - 1, x[0] + x[1] - 2, x[0] + x[1] - 3};
        J = {1, 1, 1, 1, 1, 1};
      });
  CHECK_THROWS_AS(minimise(twins, {0, 0}), Error);
}

TEST_CASE("minimise: a minimum at infinity is given up where it is not worth the way", "[fit]") {
  // 2/sqrt(x) falls for ever; along a winding edge, which no step follows far.
  constexpr std::size_t n = 50;
  int evaluations = 0;
  const System edge = one_run(
      n, 2, [&](const std::vector<double>& x, std::vector<double>& f, std::vector<double>& J) {
        ++evaluations;
        if (!(x[0] > 0)) fail("not allowed");
        for (std::size_t i = 0; i < n; ++i) f[i] = i % 2 ? 1 : -1;
        const double side = x[1] > std::sin(x[0]) ? 1 : -1;
        f[0] = 1 + side * (x[1] - std::sin(x[0]));
        J[0] = -side * std::cos(x[0]);
        J[n] = side;
        f[1] = 2 / std::sqrt(x[0]);
        J[1] = -f[1] / (2 * x[0]);
      });
  CHECK_THROWS_AS(minimise(edge, {1, 0.3}), Error);
  CHECK(evaluations < 150);  // some 70; 20 rounds take more than 300
}

TEST_CASE("minimise: a line through many rows has the sums of the closed form, and R^T R = J^T J",
          "[fit]") {
  simulated::Noise noise(3);
  constexpr std::size_t n = 1000;  // several blocks, the last one short
  std::vector<double> t, y;
  for (std::size_t i = 0; i < n; ++i)
    t.push_back(static_cast<double>(i) - 499.5), y.push_back(3 - 0.01 * t.back() + noise(0.1));
  const System line = line_through(t, y);
  const auto m = minimise(line, {0, 0});
  long double mean = 0, ty = 0;
  for (std::size_t i = 0; i < n; ++i) mean += y[i], ty += static_cast<long double>(t[i]) * y[i];
  constexpr double tt = n * (n * n - 1.0) / 12;
  CHECK(std::abs(m.theta[0] - static_cast<double>(mean / n)) < 1e-14);
  CHECK(std::abs(m.theta[1] - static_cast<double>(ty / tt)) < 1e-16);
  std::vector<double> mean_of{1, 0}, slope_of{0, 1};
  m.R.solve_transposed(0, mean_of), m.R.solve_transposed(0, slope_of);
  CHECK(std::abs(n * mean_of[0] * mean_of[0] - 1) < 1e-13);
  CHECK(std::abs(mean_of[1]) < 1e-9);  // the times are centred
  CHECK(std::abs(tt * slope_of[1] * slope_of[1] - 1) < 1e-13);
}

TEST_CASE(
    "minimise: runs with parameters of their own have the minimum and the errors of one dense "
    "problem",
    "[fit]") {
  // f = x exp(-k t) + y - data: x and y of each of three runs, and one k; dense: one run with all
  // seven.
  simulated::Noise noise(11);
  constexpr std::size_t runs = 3, each = 20, n = runs * each;
  std::vector<double> data;
  for (std::size_t i = 0; i < n; ++i)
    data.push_back((1 + static_cast<double>(i / each)) *
                       std::exp(-1.5 * static_cast<double>(i % each) / each) +
                   noise(0.05));
  const auto row = [&](const std::vector<double>& x, std::size_t i) {
    const double t = static_cast<double>(i % each) / each,
                 decay = std::exp(-x[6] * t), *const own = &x[2 * (i / each)];
    return std::array{own[0] * decay + own[1] - data[i], decay, 1.0, -t * own[0] * decay};
  };
  const System dense = one_run(
      n, 7, [&](const std::vector<double>& x, std::vector<double>& f, std::vector<double>& J) {
        for (std::size_t i = 0; i < n; ++i) {
          const auto [value, by_x, by_y, by_k] = row(x, i);
          f[i] = value;
          J[2 * (i / each) * n + i] = by_x;
          J[(2 * (i / each) + 1) * n + i] = by_y;
          J[6 * n + i] = by_k;
        }
      });
  const System blocks{
      {each, each, each}, 2, 1, [&](const std::vector<double>& x, const TakeRows& take) {
        for (std::size_t r = 0; r < runs; ++r) {
          std::vector<double> f(each), J(3 * each);
          for (std::size_t i = 0; i < each; ++i)
            std::tie(f[i], J[i], J[each + i], J[2 * each + i]) =
                std::tuple_cat(row(x, r * each + i));
          take(r, f, J);
        }
      }};
  const std::vector<double> start{1, 0, 1, 0, 1, 0, 0.2};  // far enough for Levenberg and Marquardt
  const auto one = minimise(dense, start), many = minimise(blocks, start);
  for (std::size_t j = 0; j < 7; ++j) CHECK(std::abs(many.theta[j] / one.theta[j] - 1) < 1e-10);
  CHECK(std::abs(many.rss / one.rss - 1) < 1e-12);

  // The covariance of two functions of the parameters, of their gradients.
  const auto covariance =
      [](const Triangles& R, std::size_t run, std::vector<double> g, std::vector<double> h) {
    R.solve_transposed(run, g), R.solve_transposed(run, h);
    return dot(g, h);
  };
  const auto place = [](std::size_t run, std::size_t j) { return j < 2 ? 2 * run + j : 6; };
  for (std::size_t r = 0; r < runs; ++r)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) {
        std::vector<double> g(7, 0), h(7, 0), g_run(3, 0), h_run(3, 0);
        g[place(r, j)] = h[place(r, k)] = g_run[j] = h_run[k] = 1;
        CHECK(std::abs(covariance(many.R, r, g_run, h_run) / covariance(one.R, 0, g, h) - 1) <
              1e-8);
      }

  // Q^T Q = I, where the shared column is that of all runs.
  const auto Q = orthonormal(blocks, many);
  for (std::size_t r = 0; r < runs; ++r)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) {
        const bool shared = j == 2 && k == 2;
        double sum = 0;
        for (std::size_t i = shared ? 0 : r * each; i < (shared ? n : (r + 1) * each); ++i)
          sum += Q[j][i] * Q[k][i];
        CHECK(std::abs(sum - (j == k)) < 1e-10);
      }

  const double freedom = n - 7;
  CHECK(std::abs(restricted_likelihood(many) -
                 (-freedom / 2 * std::log(one.rss) - one.R.log_determinant())) < 1e-9);
}

TEST_CASE("minimise: a start at which the model has no finite values is refused", "[fit]") {
  const System root = one_run(
      1, 1, [](const std::vector<double>& x, std::vector<double>& f, std::vector<double>& J) {
        f = {std::sqrt(x[0]) - 2};
        J = {0.5 / std::sqrt(x[0])};
      });
  CHECK(std::abs(minimise(root, {1}).theta[0] - 4) < 1e-12);
  CHECK_THROWS_AS(minimise(root, {-1}), Error);
}
