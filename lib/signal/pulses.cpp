// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/pulses.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/median.h"
#include "base/grid.h"

namespace rolling {
namespace {

/// `row`: 1 where the speed of a row is that since the row before, 0 where it is that to the next.
std::optional<double> way_by(std::span<const double> t, std::span<const double> v,
                             std::size_t row) {
  const double of_t = grid_of(t), of_v = grid_of(v);
  std::vector<double> ways, rounding, steps;
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    const double step = t[i + 1] - t[i], speed = v[i + row];
    steps.push_back(step);
    ways.push_back(speed * step);
    rounding.push_back(std::abs(speed) * (of_t + program_rounding * std::abs(t[i])) +
                       step * (of_v / 2 + program_rounding * std::abs(speed)));
  }
  auto sorted = ways;
  const double way = median(sorted);
  for (std::size_t i = 0; i < ways.size(); ++i)
    if (!(std::abs(ways[i] - way) <= rounding[i])) return {};
  const auto [least, most] = std::ranges::minmax(steps);
  return *std::ranges::max_element(rounding) < 0.05 * std::abs(way) && most > 1.3 * least
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
