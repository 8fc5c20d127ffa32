// SPDX-License-Identifier: GPL-3.0-or-later
#include "statistics/logarithm_of_noise.h"

#include <algorithm>
#include <cmath>

namespace rolling {

Estimate logarithm_of_noise(double s) {
  if (s < 0.02) return {-s * s / 2 * (1 + 1.5 * s * s), s * std::sqrt(1 + 2.5 * s * s)};
  // Integrals by the midpoint rule. The substitution z = u^4 + least makes the integrands smooth at
  // the pole of the logarithm.
  constexpr int steps = 32;
  constexpr double range = 5.5;
  const double least = std::max(-range, -1 / s), length = std::sqrt(std::sqrt(range - least));
  double weight = 0, sum = 0, squares = 0;
  for (int i = 0; i < steps; ++i) {
    const double u = (i + 0.5) / steps * length, z = u * u * u * u + least,
                 w = u * u * u * std::exp(-z * z / 2), log = std::log1p(s * z);
    weight += w;
    sum += w * log;
    squares += w * log * log;
  }
  const double mean = sum / weight;
  return {mean, std::sqrt(squares / weight - mean * mean)};
}

}  // namespace rolling
