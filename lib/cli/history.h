// The `##` lines in which filters tell what they did to the numbers, read back into the filters
// themselves.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/fit.h"

namespace rolling {

/// What the `##` lines of a run say.
struct History {
  FilterChain filters;  ///< empty if nothing is known
  std::optional<ShiftOf> shift_of = {};
  std::string doubt = {};    ///< why the lines are not believed; else empty
  std::size_t left_out = 0;  ///< records, by compared()
};

/// The filters that the `##` lines of a run name (smooth, differentiate, shift-from-accel), for
/// records at times t [s]. Lines of others say nothing. No filter is known if there are no times,
/// or if a line names a filter that is not linear; and a line in the name of one of these tools
/// that is not, word by word, what the tool writes is not believed.
History history_of(const std::vector<std::string>& lines, std::span<const double> t);

/// Compares what the last filter claims with the columns of the run where it was made from one to
/// the other. If only records at an end differ, the run was cut there after the filters; those that
/// their windows may have reached from the old end are left out of the run too. If others differ,
/// or fewer than 10 are left, the lines are not believed.
History compared(History, FitRun&);

/// What may be done to speeds before they are exported: the central difference of positions, and
/// what Vernier's and PASCO's programs do; and means of 2, 3 or 5 speeds, which look like some of
/// these.
std::vector<LinearFilter> filters_of_sensors();

}  // namespace rolling
