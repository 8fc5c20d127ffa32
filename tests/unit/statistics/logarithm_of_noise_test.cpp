// SPDX-License-Identifier: GPL-3.0-or-later
#include "statistics/logarithm_of_noise.h"

#include <cmath>
#include <numbers>

#include "unit/catch.h"

using namespace rolling;

// The values for other s are integrals with 25 digits (mpmath, by the substitution 1 + z s = s
// u^2).
TEST_CASE("logarithm of noise: its limits, and integrals between them", "[statistics]") {
  for (const double s : {1e-12, 1e-6, 9e-4, 0.0199, 0.0201}) {
    CHECK(std::abs(logarithm_of_noise(s).value / (-s * s / 2) - 1) < 1e-3 + 1.5 * s * s);
    CHECK(std::abs(logarithm_of_noise(s).sigma / s - 1) < 1e-3);
  }
  const struct {
    double s, mean, sigma;
  } between[] = {{0.1, -0.005077641678, 0.1012984415},
                 {0.5, -0.1255775599, 0.6599785408},
                 {2, 0.3480778419, 1.036609901},
                 {30, 2.784516031, 1.106574013}};
  for (const auto& [s, mean, sigma] : between) {
    CHECK(std::abs(logarithm_of_noise(s).value / mean - 1) < 1e-3);
    CHECK(std::abs(logarithm_of_noise(s).sigma / sigma - 1) < 1e-3);
  }
  for (const double s : {1e5, 8.8e6, 9e6, 1e12, 1e300}) {
    const double mean = std::log(s) - (std::numbers::egamma + std::numbers::ln2) / 2;
    CHECK(std::abs(logarithm_of_noise(s).value - mean) < 1e-3);
    CHECK(std::abs(logarithm_of_noise(s).sigma / (std::numbers::pi / std::sqrt(8)) - 1) < 1e-3);
  }
}
