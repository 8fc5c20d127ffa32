// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/median.h"

#include <limits>
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
  std::vector<double> numbers = noise(20000, 5);
  for (double& x : numbers) x *= 0.3;
  CHECK(deviation(numbers) == Approx(0.3).epsilon(0.02));
  for (std::size_t i = 0; i < 400; ++i) numbers[i] = 1e6;
  CHECK(deviation(numbers) == Approx(0.3).epsilon(0.05));
}
