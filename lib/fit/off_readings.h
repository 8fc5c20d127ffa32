// SPDX-License-Identifier: GPL-3.0-or-later
// Single readings that are far off the motion.
#pragma once

#include "fit/fitted.h"
#include "fit/result.h"

namespace rolling {

/// The readings of a roll that lie ten standard deviations off the motion of the others or further:
/// one after another the reading that is furthest off is left out, to first order, up to a tenth of
/// the run, and those up to the last that is so far off count (Rosner 1983, Technometrics 25, 165):
/// a burst does not hide behind itself. Where a reading has bent the roll too far for that, the
/// robust roll is the one to look from. None for a robust fit. For known filters the readings are
/// those of the raw column. Returns the reading that is furthest off, of the run where that is
/// most.
std::optional<OffReadings> off_readings(Route, const std::vector<FitRun>&, const FitOptions&,
                                        const Fitted&);

/// The same around the robust roll, for unfiltered runs of which no fit by squares need be known.
std::optional<OffReadings> off_robust_roll(Route, const std::vector<FitRun>&, FitOptions);

}  // namespace rolling
