// SPDX-License-Identifier: GPL-3.0-or-later
// The grid on which rounded readings lie, and the rounding error of the program that computed them.
#pragma once

#include <span>

namespace rolling {

/// Readings that differ by less than this share of the largest reading of the run differ by the
/// rounding error of the program that computed them, and not by a digit that it wrote.
inline constexpr double program_rounding = 1e-9;

/// No grid is told that is finer than this share of the largest reading.
inline constexpr double finest_grid = 100 * program_rounding;

/// The largest step of which the differences of all readings are whole multiples: the last place
/// that was written, or the resolution of the sensor if that is coarser. 0 where it is finer than
/// `finest_grid`, or where all readings are equal. Missing readings do not count. Of
/// long columns about a thousand readings are looked at.
double grid_of(std::span<const double> readings);

}  // namespace rolling
