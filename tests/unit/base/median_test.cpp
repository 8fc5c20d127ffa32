// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/median.h"

#include <limits>
#include <random>
#include <vector>

#include "unit/catch.h"
#include "unit/normal.h"

using namespace rolling;

TEST_CASE("sizes: missing numbers and signs do not count", "[base]") {
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  CHECK(typical_size({missing, -3, 1, missing, -2}) == 2);
  CHECK(typical_size({-4}) == 4);
  CHECK(typical_size({}) == 0);
  CHECK(typical_size({missing}) == 0);
}

TEST_CASE("sizes: the deviation is that of normal numbers, and few outliers hardly move it",
          "[base]") {
  std::mt19937 random(5);
  Normal normal;
  std::vector<double> numbers;
  for (int i = 0; i < 20000; ++i) numbers.push_back(0.3 * normal(random));
  CHECK(deviation(numbers) == Approx(0.3).epsilon(0.02));
  for (std::size_t i = 0; i < 400; ++i) numbers[i] = 1e6;
  CHECK(deviation(numbers) == Approx(0.3).epsilon(0.05));
}
