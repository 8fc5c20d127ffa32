// Where in a record the body rolls by itself: after the last push or hold, up to the stop.
#pragma once

#include <cstddef>
#include <span>

#include "signal/windows.h"

namespace rolling {

/// The samples from begin to before end of a run of positions, or of speeds, which may be noisy and
/// begin and end at rest.
///
/// The roll ends where the body that has had the greatest speed of the run comes to rest: k samples
/// before the local speed, the mean over 2k + 1 samples, has fallen to twice its noise. k is 2, or
/// as much more as brings that noise below 2 % of the greatest speed, or as low as it comes in up
/// to a tenth of the run.
///
/// It begins after the last corner of the speed before that: where the body, over one window, slows
/// down less than half as fast as over the next window of the same length, or gains speed. Under a
/// law D = a v^b with b > -0.5 a body that rolls by itself has no such corner, since
/// v = (c (T - t))^(1 / (1 - b)): the ratio of the two is least for the last two windows before the
/// stop T, 2^(1 / (1 - b)) - 1. Windows are of 4 samples, 4 means of 2 neighbours, of 4, and so on;
/// a corner counts if it stands out of their noise by 5 standard deviations and adds 5 % of the
/// greatest speed in a window; one or two readings that do not belong make none. The roll begins
/// k + 3 samples after the local speed is last within its noise of the greatest behind the corner.
/// A record without a corner begins with the roll. O(n log n).
///
/// A hand that slows the body down is not told from the roll. Throws Error when nothing moves.
struct Stretch {
  std::size_t begin, end;
};
Stretch free_roll(std::span<const Sample> run, bool positions);

}  // namespace rolling
