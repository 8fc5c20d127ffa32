// SPDX-License-Identifier: GPL-3.0-or-later
// The resolution of readings that are rounded.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/rounding.h"
#include "signal/windows.h"

namespace rolling {

/// The smallest difference between neighbours above the rounding error of a program: the resolution
/// of the readings, if they are rounded. 0 if no two neighbours are equal (light gates); infinite
/// if all are.
inline double smallest_step(std::span<const Sample> readings) {
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

}  // namespace rolling
