// SPDX-License-Identifier: GPL-3.0-or-later
// The logarithm of a number with normal noise.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/estimate.h"

namespace rolling {

/// The mean and the standard deviation of ln(1 + e) for normal e of standard deviation s > 0,
/// conditional on 1 + e > 0, where the logarithm exists, each within 1e-3 of its size. For small s
/// they are -s^2/2 and s; for large s the mean is ln s - (gamma + ln 2)/2 (gamma is Euler's
/// constant) and the standard deviation is pi/sqrt(8).
inline Estimate logarithm_of_noise(double s) {
  if (s < 0.02) return {-s * s / 2 * (1 + 1.5 * s * s), s * std::sqrt(1 + 2.5 * s * s)};
  // Integrals by the midpoint rule. The substitution z = u^4 + least makes the integrands smooth at
  // the pole of the logarithm.
  constexpr int steps = 32;
  constexpr double range = 5.5;
  const double least = std::max(-range, -1 / s);
  const double length = std::sqrt(std::sqrt(range - least));
  double weight = 0;
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < steps; ++i) {
    const double u = (i + 0.5) / steps * length;
    const double z = u * u * u * u + least;
    const double w = u * u * u * std::exp(-z * z / 2);
    const double log = std::log1p(s * z);
    weight += w;
    sum += w * log;
    squares += w * log * log;
  }
  const double mean = sum / weight;
  return {mean, std::sqrt(squares / weight - mean * mean)};
}

}  // namespace rolling
