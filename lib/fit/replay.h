// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the columns of a run are what their filters make of each other.
#pragma once

#include "fit/input.h"

namespace rolling {

/// How a run differs from its filters.
struct Mismatch {
  bool inside = false;              ///< the columns are not those of these filters
  bool begin = false, end = false;  ///< only there, where a window may reach beyond the run
};

/// Applies the filters again to the columns of the run that no later filter has changed (x, v, and
/// for D the acceleration from which shift_of computed it) and compares each column that they make.
/// What differs from it by the rounding of the numbers, or by much less than its noise, is the
/// same. Columns that are missing, and the windows of missing readings, are not compared.
Mismatch mismatch(const FilterChain&, const FitRun&);

}  // namespace rolling
