// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/resolution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/median.h"
#include "base/grid.h"
#include "signal/polynomial.h"

namespace rolling {

double smallest_step(std::span<const Sample> readings) {
  double largest = 0, step = std::numeric_limits<double>::infinity();
  bool repeats = false;
  for (const Sample& s : readings) largest = std::max(largest, std::abs(s.y));
  for (std::size_t i = 1; i < readings.size(); ++i)
    if (const double here = std::abs(readings[i].y - readings[i - 1].y);
        here > program_rounding * largest)
      step = std::min(step, here);
    else repeats = true;
  return repeats ? step : 0;
}

double noise_of(std::span<const Sample> samples, bool positions, double step) {
  constexpr double least = 1e-6;  // of the range of readings: what no sensor resolves
  constexpr std::size_t size = 9;
  constexpr double typical = 0.94;  // median of normal noise
  std::vector<double> moved, scatter;
  for (std::size_t i = 0; i + size <= samples.size(); ++i) {
    const auto near = samples.subspan(i, size);
    Polynomial<3> fit;
    for (const Sample& s : near) fit.add(s.t - near[0].t, s.y);
    moved.push_back(std::abs(positions ? near.back().y - near[0].y : near[size / 2].y));
    scatter.push_back(std::sqrt(fit.rss() / (size - 3)) / typical);
  }
  const double noise = std::max(least, positions ? step / std::sqrt(12) : step);
  if (moved.empty()) return noise;
  std::vector<double> speeds = moved;
  const double slow = 0.2 * nth_smallest(speeds, speeds.size() - 1 - speeds.size() / 50);
  std::vector<double> moving;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (moved[i] >= slow) moving.push_back(scatter[i]);
  return std::max(noise, median(moving));
}

}  // namespace rolling
