// When a body that moved at constant speed was let go.
#pragma once

#include <cstddef>
#include <span>

#include "signal/windows.h"

namespace rolling {

/// The body was let go between these samples: 2.5 standard errors to either side, as far as the
/// samples reach.
struct Release {
  std::size_t earliest, latest;
  double significance;  ///< of a hold at the beginning, in standard deviations
};

/// By least squares on at least 8 samples: the speed is constant, and from the release on falls in
/// a straight line; the position, the integral of that. The noise of the samples is taken as white.
/// `falling` is 1 for a body that moves forwards, -1 for one that moves backwards. O(100 n).
Release release_of(std::span<const Sample>, bool positions, double falling);

}  // namespace rolling
