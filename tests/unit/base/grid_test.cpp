// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/grid.h"

#include <cmath>
#include <random>

#include "unit/catch.h"

using namespace rolling;

TEST_CASE("the grid of rounded readings is the last place that was written") {
  std::mt19937 random(5);
  for (const double grid : {1e-3, 1.0, 0.25, 1 / 3.6, 0.0254}) {
    std::vector<double> y{NAN};
    for (int i = 0; i < 3000; ++i) y.push_back(grid * static_cast<double>(random() % 4000));
    CHECK(grid_of(y) == Approx(grid).epsilon(1e-9));
    y[1001] += grid / 2;  // of long columns not all readings are looked at
    CHECK(grid_of(std::span(y).first(600)) == Approx(grid).epsilon(1e-9));
  }
}

TEST_CASE("unrounded readings have no grid, nor have equal ones") {
  std::mt19937 random(5);
  std::vector<double> y;
  for (int i = 0; i < 50; ++i) y.push_back(std::sqrt(static_cast<double>(random())));
  CHECK(grid_of(y) == 0);
  CHECK(grid_of(std::vector<double>(20, 0.7)) == 0);
  CHECK(grid_of(std::vector<double>{}) == 0);
}
