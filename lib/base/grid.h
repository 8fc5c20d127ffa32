// SPDX-License-Identifier: GPL-3.0-or-later
// The grid on which rounded readings lie.
#pragma once

#include <span>

namespace rolling {

/// The largest step of which the differences of all readings are whole multiples: the last place
/// that was written, or the resolution of the sensor if that is coarser. 0 where it is not above
/// the rounding of the program, or where all readings are equal. Missing readings do not count. Of
/// long columns about a thousand readings are looked at.
double grid_of(std::span<const double> readings);

}  // namespace rolling
