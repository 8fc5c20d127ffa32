// SPDX-License-Identifier: GPL-3.0-or-later
// Search for the free roll among the pieces of a run.
#pragma once

#include <optional>
#include <span>

#include "selection/free_roll.h"
#include "signal/windows.h"

namespace rolling {

/// The free roll in samples of this noise, none of which is an outlier; empty if there is none.
/// Times and indices are those of the samples.
std::optional<FreeRoll> search_roll(std::span<const Sample> samples, bool positions, double noise);

}  // namespace rolling
