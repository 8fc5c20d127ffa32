// SPDX-License-Identifier: GPL-3.0-or-later
// Search for the free rolls among the pieces of a run.
#pragma once

#include <span>
#include <vector>

#include "selection/free_roll.h"
#include "signal/windows.h"

namespace rolling {

/// The free rolls in samples of this noise without outliers: those that slow down alike
/// at the same speed, the longest first. Times and indices are those of the samples. Each sample
/// is a mean of so many rows, which blurs the joints.
std::vector<FreeRoll> search_rolls(std::span<const Sample> samples, bool positions, double noise,
                                   std::size_t rows = 1);

}  // namespace rolling
