// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/pulses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "base/grid.h"

namespace rolling {
namespace {

/// The last place that was written of the readings, or an upper bound where grid_of() tells none.
double place_of(std::span<const double> readings) {
  const auto [least, most] = std::ranges::minmax(readings);
  return std::max(grid_of(readings), finest_grid * std::max(std::abs(least), std::abs(most)));
}

/// The way that all rows allow, each by the rounding of its numbers. `row`: 1 where the speed of a
/// row is that since the row before, 0 where it is that to the next.
std::optional<double> way_by(std::span<const double> t, std::span<const double> v,
                             std::size_t row) {
  std::vector<double> since_first(t.begin(), t.end());
  for (double& time : since_first) time -= t[0];
  const double of_clock = std::numeric_limits<double>::epsilon() *
                          (std::abs(t.front()) + std::abs(t.back())),
               of_t = place_of(since_first) + of_clock, of_v = place_of(v);
  double least = -std::numeric_limits<double>::infinity(), most = -least, coarsest = 0;
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    const double step = t[i + 1] - t[i], speed = v[i + row],
                 rounding = std::abs(speed) * of_t + step * of_v / 2;
    if (std::isnan(speed)) return {};
    steps.push_back(step);
    coarsest = std::max(coarsest, rounding);
    least = std::max(least, speed * step - rounding),
    most = std::min(most, speed * step + rounding);
  }
  const double way = std::midpoint(least, most);
  const auto [shortest, longest] = std::ranges::minmax(steps);
  return least <= most && coarsest < 0.05 * std::abs(way) && longest > 1.3 * shortest
             ? std::optional(way)
             : std::nullopt;
}

}  // namespace

std::optional<double> way_between_pulses(std::span<const double> t, std::span<const double> v) {
  if (t.size() < 5 || v.size() != t.size()) return {};
  const auto since = way_by(t, v, 1);
  return since ? since : way_by(t, v, 0);
}

}  // namespace rolling
