// SPDX-License-Identifier: GPL-3.0-or-later
// The grid on which rounded readings lie, and the rounding error of the program that computed them.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace rolling {

/// Readings that differ by less than this share of the largest reading of the run differ by the
/// rounding error of the program that computed them, and not by a digit that it wrote.
inline constexpr double program_rounding = 1e-9;

/// A grid that is finer than this share of the largest reading counts as none.
inline constexpr double finest_grid = 100 * program_rounding;

/// The largest step of which the differences of all readings are whole multiples: the last place
/// that was written, or the resolution of the sensor if that is coarser. 0 where it is finer than
/// `finest_grid`, or where all readings are equal. Missing readings do not count. Of
/// long columns about a thousand readings are looked at.
inline double grid_of(std::span<const double> readings) {
  const std::size_t step = 1 + readings.size() / 1000;
  double first = NAN;
  double largest = 0;
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
      if (grid == 0) grid = difference;
      const double next = std::abs(std::remainder(rest, grid));
      if (next <= std::max(rounding, 1e-3 * grid)) {
        grid = difference / std::round(difference / grid);
        break;
      }
      rest = std::exchange(grid, next);
    }
    if (grid > 0 && grid < finest_grid * largest) return 0;
  }
  return grid;
}

}  // namespace rolling
