// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rolling {

double grid_of(std::span<const double> readings) {
  const std::size_t step = 1 + readings.size() / 1000;
  double first = NAN, largest = 0;
  for (std::size_t i = 0; i < readings.size(); i += step) {
    if (std::isnan(first)) first = readings[i];
    if (std::isfinite(readings[i])) largest = std::max(largest, std::abs(readings[i]));
  }
  const double rounding = program_rounding * largest;
  double grid = 0;
  for (std::size_t i = 0; i < readings.size(); i += step) {
    const double difference = std::abs(readings[i] - first);
    // Euclid's algorithm. Errors of the grid grow with the multiple; the largest one tells it best.
    for (double rest = difference; rest > std::max(rounding, 1e-3 * grid);) {
      const double next = std::remainder(rest, grid > 0 ? grid : rest);
      if (std::abs(next) <= std::max(rounding, 1e-3 * grid)) {
        grid = grid > 0 ? difference / std::round(difference / grid) : rest;
        break;
      }
      rest = std::exchange(grid, std::abs(next));
    }
    if (grid > 0 && grid < finest_grid * largest) return 0;
  }
  return grid;
}

}  // namespace rolling
