// The `##` lines in which filters tell what they did to the numbers, read back into the filters themselves.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fit/filter.h"

namespace rolling {

/// The filters that the `##` lines of a run name (smooth, differentiate, shift-from-accel), for records at times t [s]. Lines
/// of others say nothing. Empty if a line names a filter that is not linear or not known here: then nothing can be said.
FilterChain filters_of(const std::vector<std::string>& history, std::span<const double> t);

/// How speeds are made of positions at the sensor: the central difference, and what Vernier's and PASCO's programs do.
std::vector<LinearFilter> speeds_of_positions();

}  // namespace rolling
