// The `##` lines in which filters tell what they did to the numbers, read back into the filters
// themselves.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/fit.h"

namespace rolling {

/// The filters that the `##` lines of a run name (smooth, differentiate, shift-from-accel), for
/// records at times t [s]. Lines of others say nothing. Empty if a line names a filter that is not
/// linear or not known here: then nothing can be said.
FilterChain filters_of(const std::vector<std::string>& history, std::span<const double> t);

/// The same, and how D was made of accelerations.
struct History {
  FilterChain filters;
  std::optional<ShiftOf> shift_of = {};
};
History history_of(const std::vector<std::string>& history, std::span<const double> t);

/// What may be done to speeds before they are exported: the central difference of positions, and
/// what Vernier's and PASCO's programs do; and means of 2, 3 or 5 speeds, which look like some of
/// these.
std::vector<LinearFilter> filters_of_sensors();

}  // namespace rolling
