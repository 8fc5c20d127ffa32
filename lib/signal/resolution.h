// SPDX-License-Identifier: GPL-3.0-or-later
// The resolution of readings that are rounded, and their noise.
#pragma once

#include <span>

#include "signal/windows.h"

namespace rolling {

/// The smallest difference between neighbours above the rounding error of a program: the resolution
/// of the readings, if they are rounded. 0 if no two neighbours are equal (light gates); infinite
/// if all are.
double smallest_step(std::span<const Sample> readings);

/// The noise of samples while the body moves: the median scatter about the parabolas of few
/// neighbours. Where a body moves by less than a step of rounded positions it is at least that of
/// rounding.
double noise_of(std::span<const Sample> samples, bool positions, double step);

}  // namespace rolling
