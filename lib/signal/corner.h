// Where a body was last pushed or held: corners of its speed.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "signal/windows.h"

namespace rolling {

/// The means of t and y over blocks of `size` samples; what is left at the end belongs to none.
std::vector<Sample> means(std::span<const Sample>, std::size_t size);

/// The noise that rounding adds to the speed of blocks of m samples, rounding / m^power [m/s].
struct RoundedSpeeds {
  double rounding, power;
};

/// What counts as a corner.
struct CornerOptions {
  std::size_t size;      ///< of the first blocks, in samples
  std::size_t first;     ///< the body moves from this sample on
  double least;          ///< a corner adds so much speed in a window [m/s]
  double significance;   ///< and stands out of the noise by so many standard deviations
  RoundedSpeeds coarse;  ///< that noise is not less than this
};

/// The last corner of a way x(t) that grows; as the number of a sample, 0 if there is none.
///
/// At a corner the body, over one window, slows down less than half as fast as over the next window
/// of the same length, or gains speed. Under a law D = a v^b with b > -0.5 a body that rolls by
/// itself has no such corner, since v = (c (T - t))^(1 / (1 - b)): the ratio of the two is least
/// for the last two windows before the stop T, 2^(1 / (1 - b)) - 1. Windows are of 4 speeds between
/// means over blocks of the way, of `size` samples, of 2 size, of 4 size, and so on. O(n log n).
std::size_t last_corner(std::span<const Sample> way, const CornerOptions&);

}  // namespace rolling
