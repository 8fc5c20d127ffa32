// Detection of the last push or hold of a body: corners of its speed.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "signal/windows.h"

namespace rolling {

/// The means of t and y over consecutive blocks of `size` samples; an incomplete last block is
/// dropped.
std::vector<Sample> means(std::span<const Sample>, std::size_t size);

/// The noise of the speed of blocks of m samples that comes from rounding, rounding / m^power
/// [m/s].
struct RoundedSpeeds {
  double rounding, power;
};

/// The criteria for a corner.
struct CornerOptions {
  std::size_t size;      ///< samples in a block of the first pass
  std::size_t first;     ///< index of the first sample at which the body moves
  double least;          ///< least gain of speed in a window [m/s]
  double significance;   ///< least gain relative to the standard deviation of the noise
  RoundedSpeeds coarse;  ///< lower bound of that noise
};

/// The last corner of a distance x(t) that grows, as the index of a sample; 0 if there is none.
///
/// At a corner the body slows down, over one window, less than half as fast as over the next window
/// of the same length, or it gains speed. A freely rolling body with a law D = a v^b, b > -0.5, has
/// no corner: v = (c (T - t))^(1 / (1 - b)), and the ratio of the two decelerations is least for
/// the last two windows before the stop T, 2^(1 / (1 - b)) - 1. A window holds 4 speeds, which are
/// differences of block means of x; the blocks hold `size` samples, then 2 size, 4 size, and so on.
/// O(n log n).
std::size_t last_corner(std::span<const Sample> way, const CornerOptions&);

}  // namespace rolling
