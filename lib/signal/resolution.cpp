// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/resolution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
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
  double noise = std::max(least, positions ? step / std::sqrt(12) : step);
  for (const auto& [size, typical] :
       {std::pair<std::size_t, double>{4, 0.6745}, {9, 0.94}, {25, 0.98}}) {
    std::vector<std::pair<double, double>> found;  // speed, scatter
    std::vector<double> speeds, scatter, all;
    for (std::size_t i = 0; i + size <= samples.size(); ++i) {
      const auto near = samples.subspan(i, size);
      Polynomial<3> fit;
      for (const Sample& s : near) fit.add(s.t - near[0].t, s.y);
      const double own = std::sqrt(fit.rss() / static_cast<double>(size - 3)),
                   moved = std::abs(positions ? near.back().y - near[0].y : near[size / 2].y);
      all.push_back(own);
      if (own > 0.12 * moved) continue;  // a jump or rest
      const bool coarse = positions && moved < 0.99 * step * static_cast<double>(size - 1);
      found.push_back({positions ? moved / (near.back().t - near[0].t) : moved,
                       std::max(own / typical, coarse ? 0.43 * step : 0)});
      speeds.push_back(found.back().first);
    }
    // A quarter of all tells the noise of a run in which nothing moves.
    if (size == 4 && !all.empty())
      noise = std::max(noise, nth_smallest(all, all.size() / 4) / 0.32);
    if (found.size() < (size == 4 ? 1 : 4 * size)) continue;
    const double fast = nth_smallest(speeds, speeds.size() - 1 - speeds.size() / 50);
    for (const auto& [speed, here] : found)
      if (speed >= 0.2 * fast) scatter.push_back(here);
    noise =
        std::max(noise, size == 25 ? nth_smallest(scatter, scatter.size() / 4) : median(scatter));
  }
  return noise;
}

}  // namespace rolling
