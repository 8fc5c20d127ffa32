// Where in a record the body rolls by itself: after the last push or hold, up to the stop.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "signal/windows.h"

namespace rolling {

/// The samples from begin to before end of a run of positions, or of speeds, which may be noisy and
/// begin and end at rest.
///
/// The roll ends where the body that has had the greatest speed of the run comes to rest: before
/// the last window of 2k + 1 samples whose speed is above twice its noise. k is 2, or as much more
/// as brings that noise below 2 % of the greatest speed, or as low as it comes in up to a tenth of
/// the run. That window is sought backwards, from 2k + 1 samples behind the first one that is
/// slower: so no sample that is kept has been looked at, and none is chosen by its noise.
///
/// It begins after the last corner of the speed before that (signal/corner.h) which stands out of
/// the noise by 5 standard deviations and adds 5 % of the greatest speed in a window; one or two
/// readings that do not belong make none. There, where the speed is above 0.9 of its greatest
/// behind the corner and then falls to 0.75 of it, a constant speed that begins to fall in a
/// straight line is fitted, and the roll begins 3 samples after the latest time of release that
/// agrees with the samples (signal/release.h). A record without a corner, and without a hold of
/// such significance at its beginning, begins with the roll.
///
/// The beginning is in doubt if corners of 3.5 standard deviations put it elsewhere, by more than a
/// tenth of the roll.
///
/// More than 20 000 samples are seen through the means of blocks, 10 000 in a run, then again about
/// the roll, the finer the shorter it is. O(n).
///
/// A hand that slows the body down is not told from the roll. Throws Error when nothing moves.
struct Stretch {
  std::size_t begin, end;
  std::optional<std::size_t> other = {};  ///< where it is in doubt: it may begin at this sample
};
Stretch free_roll(std::span<const Sample> run, bool positions);

}  // namespace rolling
