// Where in a record the body rolls by itself: after the push, up to the stop.
#pragma once

#include <cstddef>
#include <span>

#include "signal/windows.h"

namespace rolling {

/// The samples from begin to before end of a run of positions, or of speeds, which may be noisy and
/// begin and end at rest.
///
/// The local speed is the slope of the line (of positions) or the mean (of speeds) over 2k + 1
/// samples; k is 2, or as much more as brings its noise below 2 % of the greatest speed, or as low
/// as it comes in up to a tenth of the run. The push ends where the local speed is last within its
/// noise of the greatest; the roll begins k + 3 samples later, when neither that window nor a
/// derivative over two samples to either side knows of the push. It ends k samples before the local
/// speed has fallen to twice its noise. A hand that stops the body is not told from the roll.
/// Throws Error when nothing moves.
struct Stretch {
  std::size_t begin, end;
};
Stretch free_roll(std::span<const Sample> run, bool positions);

}  // namespace rolling
