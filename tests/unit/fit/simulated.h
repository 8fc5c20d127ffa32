// SPDX-License-Identifier: GPL-3.0-or-later
// Simulated runs for the tests of fit/, from closed formulas that are typed here and not taken from
// lib/motion.
#pragma once

#include "fit/fit.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace simulated {

/// v(t) and x(t) of Eq. 13 for b other than 1 and 2.
struct Roll {
  double c, a, b, v0;
  double v(double t) const {
    return std::pow(std::max(0.0, std::pow(v0, 1 - b) - (1 - b) * a * c * t), 1 / (1 - b));
  }
  double x(double t) const {
    return (std::pow(v0, 2 - b) - std::pow(v(t), 2 - b)) / (a * c * (2 - b));
  }
};

inline Roll roll(const rolling::Body& body, double a, double b, double v0) {
  return {body.g / ((1 + body.K) * body.R), a, b, v0};
}

inline std::vector<double> times(std::size_t n) {  // a tenth of a second apart
  std::vector<double> t;
  for (std::size_t i = 0; i < n; ++i) t.push_back(0.1 * static_cast<double>(i));
  return t;
}

inline std::vector<double> mean(std::span<const double> y, std::size_t width) {
  std::vector<double> result;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const std::size_t half = std::min({width / 2, i, y.size() - 1 - i});
    double sum = 0;
    for (std::size_t j = i - half; j <= i + half; ++j) sum += y[j];
    result.push_back(sum / static_cast<double>(2 * half + 1));
  }
  return result;
}

/// Central differences on even times, with second-order ends.
inline std::vector<double> slope(std::span<const double> t, std::span<const double> y) {
  const std::size_t n = y.size();
  const double h = t[1] - t[0];
  std::vector<double> result(n);
  for (std::size_t i = 1; i + 1 < n; ++i) result[i] = (y[i + 1] - y[i - 1]) / (2 * h);
  result[0] = (-3 * y[0] + 4 * y[1] - y[2]) / (2 * h);
  result[n - 1] = (3 * y[n - 1] - 4 * y[n - 2] + y[n - 3]) / (2 * h);
  return result;
}

inline rolling::LinearFilter smooth_v(std::size_t width) {
  return {rolling::Quantity::v, rolling::Quantity::v, width / 2,
          [width](std::span<const double>, std::span<const double> y) { return mean(y, width); }};
}
inline rolling::LinearFilter differentiate(rolling::Quantity from, rolling::Quantity to) {
  return {from, to, 1,
          [](std::span<const double> t, std::span<const double> y) { return slope(t, y); }};
}
/// The last filter of a chain to D, which stands for the acceleration.
inline rolling::LinearFilter shift() {
  return {rolling::Quantity::a, rolling::Quantity::D, 0,
          [](std::span<const double>, std::span<const double> y) {
    return std::vector<double>(y.begin(), y.end());
          }};
}
/// v and D of a run of raw readings, smoothed over `width` speeds and differentiated, by Eq. 11
/// with A = 1; the filters are known.
inline rolling::Run shifts(const rolling::Body& body, std::vector<double> t,
                           std::vector<double> raw, std::size_t width, const char* source = "v") {
  rolling::Run run{};
  run.shift_of = body;
  if (source[0] == 'x') {
    run.filters.push_back(differentiate(rolling::Quantity::x, rolling::Quantity::v));
    raw = slope(t, raw);
  }
  run.filters.push_back(smooth_v(width));
  run.filters.push_back(differentiate(rolling::Quantity::v, rolling::Quantity::a));
  run.filters.push_back(shift());
  run.v = mean(raw, width);
  run.D = slope(t, run.v);
  for (double& D : run.D) D *= -(1 + body.K) * body.R / body.g;
  run.t = std::move(t);
  return run;
}

/// White noise of a fixed seed, the same on every machine: sums of twelve uniform numbers.
class Noise {
 public:
  explicit Noise(unsigned seed) : random_(seed) {}
  double operator()(double sd) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random_()) / 4294967296.0;
    return sd * sum;
  }

 private:
  std::mt19937 random_;
};

}  // namespace simulated
