// SPDX-License-Identifier: GPL-3.0-or-later
#include "statistics/logarithm_of_noise.h"

#include <algorithm>
#include <cmath>

namespace rolling {
namespace {

/// The mean and the standard deviation of the logarithm, each by an integral.
Estimate logarithm_of_noise(double s) {
  // The substitution z = u^2 + least makes the integrands smooth at the pole of the logarithm. The
  // midpoint rule with this number of steps then has an error below 5e-4.
  constexpr int steps = 200;
  constexpr double range = 6;
  const double least = std::max(-range, -1 / s), length = std::sqrt(range - least);
  double weight = 0, sum = 0, squares = 0;
  for (int i = 0; i < steps; ++i) {
    const double u = (i + 0.5) / steps * length, z = least + u * u, w = u * std::exp(-z * z / 2);
    const double log = least > -range ? std::log(s * u * u) : std::log1p(s * z);
    weight += w;
    sum += w * log;
    squares += w * log * log;
  }
  const double mean = sum / weight;
  return {mean, std::sqrt(squares / weight - mean * mean)};
}

}  // namespace

Estimate LogarithmOfNoise::operator()(double s) {
  const double place = (std::log(s) - least) * places;
  if (place < 0) return {-s * s / 2, s};
  const std::size_t i = std::min(static_cast<std::size_t>(place), table_.size() - 2);
  const double share = place - static_cast<double>(i);  // above 1 beyond the end
  const Estimate low = at(i), high = at(i + 1);
  return {std::lerp(low.value, high.value, share), std::lerp(low.sigma, high.sigma, share)};
}

Estimate LogarithmOfNoise::at(std::size_t i) {
  if (table_[i].sigma == 0)
    table_[i] = logarithm_of_noise(std::exp(least + static_cast<double>(i) / places));
  return table_[i];
}

}  // namespace rolling
