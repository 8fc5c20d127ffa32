// Search for the free roll in a record: from the last push or hold to the stop.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "signal/windows.h"

namespace rolling {

/// The samples [begin, end) of the free roll in a run of positions or speeds. The run may be noisy
/// and may begin and end at rest.
///
/// The end. The roll ends where the body, after its greatest speed in the run, comes to rest:
/// before the last window of 2k + 1 samples whose speed is above twice its noise. k is 2, or larger
/// so that the noise falls below 2 % of the greatest speed, or as low as windows of up to a tenth
/// of the run allow. The noise of positions is at least that of their rounding. The search for that
/// window goes backwards, from 2k + 1 samples behind the first slower one. No sample that is kept
/// has decided, so that no sample is selected by its noise.
///
/// The beginning. The roll begins after the last corner of the speed (signal/corner.h) that exceeds
/// 5 standard deviations of the noise and adds 5 % of the greatest speed in a window; one or two
/// outliers make no corner. The samples around it are used where the speed is above 0.9 of its
/// maximum after the corner and until it falls to 0.75 of it. A constant speed followed by a linear
/// decrease is fitted to them, and the roll begins 3 samples after the latest time of release that
/// agrees with the samples (signal/release.h). If there is neither a corner nor a significant hold
/// at the beginning, the roll begins with the first sample.
///
/// The beginning is doubtful if corners of 3.5 standard deviations move it by more than a tenth of
/// the roll.
///
/// A run of more than 20 000 samples is first reduced to 10 000 to 15 000 block means; the search
/// is then repeated around the roll with smaller blocks. O(n).
///
/// A hand that slows the body down is not distinguished from the roll. Throws Error if nothing
/// moves or no roll is found.
struct Stretch {
  std::size_t begin, end;
  std::optional<std::size_t> other = {};  ///< the other possible beginning, if it is doubtful
};
Stretch free_roll(std::span<const Sample> run, bool positions);

}  // namespace rolling
