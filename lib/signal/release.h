// Estimate of the time of release of a body that moved at constant speed before.
#pragma once

#include <cstddef>
#include <span>

#include "signal/windows.h"

namespace rolling {

/// The body was released between these samples: the interval of 2.5 standard errors to either side,
/// within the range of the samples.
struct Release {
  std::size_t earliest, latest;
  double significance;  ///< of a motion at constant speed at the beginning, in standard deviations
};

/// Estimates the release by least squares on at least 8 samples. Model: the speed is constant and
/// falls linearly from the release on; a position is the integral of that speed. The noise is
/// assumed white. `falling` is 1 for a body that moves towards growing x, -1 otherwise. O(100 n).
Release release_of(std::span<const Sample>, bool positions, double falling);

}  // namespace rolling
