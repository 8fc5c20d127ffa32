// SPDX-License-Identifier: GPL-3.0-or-later
#include "statistics/logarithm_of_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace rolling {

Estimate logarithm_of_noise(double s) {
  if (s < 0.02) return {-s * s / 2 * (1 + 1.5 * s * s), s * std::sqrt(1 + 2.5 * s * s)};
  // Integrals by the midpoint rule. The substitution z = u^4 + least makes the integrands smooth at
  // the pole of the logarithm.
  constexpr std::size_t steps = 32;
  static const auto shares = [] {  // of the largest u, and their logarithms
    std::array<std::pair<double, double>, steps> all;
    for (std::size_t i = 0; i < steps; ++i)
      all[i].first = (static_cast<double>(i) + 0.5) / steps, all[i].second = std::log(all[i].first);
    return all;
  }();
  constexpr double range = 5.5;
  const double least = std::max(-range, -1 / s), length = std::sqrt(std::sqrt(range - least)),
               log_s = std::log(s) + std::log(range - least);
  double weight = 0, sum = 0, squares = 0;
  for (const auto& [share, log_share] : shares) {
    const double u = share * length, z = u * u * u * u + least,
                 w = u * u * u * std::exp(-z * z / 2),
                 log = least > -range ? log_s + 4 * log_share : std::log1p(s * z);
    weight += w;
    sum += w * log;
    squares += w * log * log;
  }
  const double mean = sum / weight;
  return {mean, std::sqrt(squares / weight - mean * mean)};
}

}  // namespace rolling
