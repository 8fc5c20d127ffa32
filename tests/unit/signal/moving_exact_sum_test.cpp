// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/moving.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "unit/signal/exact.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

double mean_of(const std::vector<double>& values) {
  ExactSum sum;
  for (const double y : values) sum.add(y);
  return sum.over(values.size());
}

constexpr double largest = std::numeric_limits<double>::max(),
                 tiny = std::numeric_limits<double>::denorm_min();

}  // namespace

TEST_CASE("exact_sum: what can be said by hand", "[signal]") {
  CHECK(mean_of({1, 2, 3}) == 2);
  CHECK(mean_of({-1, -2}) == -1.5);
  CHECK(mean_of({1, -1}) == 0);
  CHECK(mean_of({-0.0}) == 0);
  CHECK(std::signbit(mean_of({-0.0})));
  CHECK(std::signbit(mean_of({-0.0, -0.0})));
  CHECK_FALSE(std::signbit(mean_of({-0.0, 0.0})));
  CHECK_FALSE(std::signbit(mean_of({1, -1})));
  CHECK(mean_of({1e308, 1e308, 1e308}) == 1e308);
  CHECK(mean_of({largest, largest, largest, largest}) == largest);
  CHECK(mean_of({-largest, -largest}) == -largest);
  CHECK(mean_of({largest, -largest, 3}) == 1);
  CHECK(mean_of({tiny, tiny, tiny}) == tiny);
  CHECK(mean_of({tiny, tiny, -5 * tiny}) == -tiny);
  CHECK(mean_of({1e308, tiny, -1e308}) * 3 == 0);  // a third of the least number rounds to nothing
  CHECK(mean_of({0x1p900, -0x1p899, -0x1p899, 4 * tiny}) == tiny);
  CHECK(mean_of({9e33, 1, -9e33}) == 1. / 3);
  CHECK(mean_of({0.1}) == 0.1);
}

TEST_CASE("exact_sum: an even count of one number is that number", "[signal]") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> mantissa(-2, 2);
  for (int exponent = -1074; exponent < 1023; exponent += 13) {
    const double y = std::ldexp(mantissa(random), exponent);
    for (const std::size_t n : {1u, 2u, 3u, 7u, 11u, 101u})
      CHECK(mean_of(std::vector<double>(n, y)) == y);
  }
}

TEST_CASE("exact_sum: a hair below a power of two rounds to it", "[signal]") {
  for (int power = -900; power < 1000; ++power) {
    const double whole = std::ldexp(1, power);
    for (const int below : {60, 84, 97, 110, 160}) {
      ExactSum sum;
      sum.add(whole);
      sum.subtract(std::ldexp(1, std::max(power - below, -1074)));
      INFO(power << " " << below);
      const double mean = sum.over(1);
      REQUIRE((mean == whole || mean == std::nextafter(whole, 0)));
    }
  }
}

TEST_CASE("exact_sum: within one ulp of the exact mean, for numbers of all sizes", "[signal]") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  int failures = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const std::size_t n = 1 + random() % 41;
    const int spread = static_cast<int>(random() % 300);
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i)
      values.push_back(std::ldexp(
          mantissa(random),
          -150 + (spread ? static_cast<int>(random() % static_cast<unsigned>(spread)) : 0)));
    if (trial % 4 == 0) values.push_back(-values.front());  // cancellation
    if (!within_one_ulp(values, mean_of(values))) ++failures;
  }
  CHECK(failures == 0);
}

TEST_CASE("exact_sum: subtracting restores the sum to the last bit", "[signal]") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::vector<double> passing;
  ExactSum sum;
  sum.add(0.1);
  sum.add(-1e-300);
  const double before = sum.over(2);
  for (int i = 0; i < 100000; ++i) {
    passing.push_back(std::ldexp(mantissa(random), static_cast<int>(random() % 2000) - 1000));
    sum.add(passing.back());
  }
  for (const double y : passing) sum.subtract(y);
  CHECK(sum.over(2) == before);
  sum.subtract(0.1);
  CHECK(sum.over(1) == -1e-300);
  sum.subtract(-1e-300);
  CHECK(sum.over(1) == 0);
  sum.add(-3);
  CHECK(sum.over(3) == -1);
}

TEST_CASE("exact_sum: terms that are exchanged leave nothing behind, near one another or not",
          "[signal]") {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::vector<double> window(7, 1.0);
  ExactSum sum;
  for (const double y : window) sum.add(y);
  int failures = 0;
  for (std::size_t i = 0; i < 20000; ++i) {
    const int kind = static_cast<int>(random() % 8);
    const double old = window[i % 7];
    const double y = kind == 0   ? 0.0
                     : kind == 1 ? -0.0
                     : kind == 2 ? 0x1p900
                     : kind == 3
                         ? std::ldexp(mantissa(random), static_cast<int>(random() % 600) - 300)
                         : old + mantissa(random) / 8;
    sum.add(y);
    sum.subtract(old);
    window[i % 7] = y;
    if (!within_one_ulp(window, sum.over(7))) ++failures;
  }
  CHECK(failures == 0);
  for (const double y : window) {
    sum.add(-0.0);
    sum.subtract(y);
  }
  CHECK(std::signbit(sum.over(7)));
  sum.add(largest);
  sum.subtract(largest);
  sum.add(-largest);
  CHECK(sum.over(1) == -largest);
}

TEST_CASE("exact_sum: -0 is forgotten with the terms that were", "[signal]") {
  ExactSum sum;
  sum.add(-0.0);
  sum.add(0.5);
  sum.subtract(0.5);
  CHECK(std::signbit(sum.over(1)));
  sum.add(0.0);
  CHECK_FALSE(std::signbit(sum.over(2)));
  sum.subtract(-0.0);
  CHECK_FALSE(std::signbit(sum.over(1)));
}

TEST_CASE("exact_sum: ten million of the largest terms do not overflow", "[signal]") {
  ExactSum sum;
  for (int i = 0; i < 10000000; ++i) sum.add(largest);
  CHECK(sum.over(10000000) == largest);
}
