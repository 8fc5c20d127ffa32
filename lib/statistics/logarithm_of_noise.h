// SPDX-License-Identifier: GPL-3.0-or-later
// The logarithm of a number with normal noise.
#pragma once

#include <vector>

#include "base/estimate.h"

namespace rolling {

/// The mean and the standard deviation of ln(1 + e) for normal e of standard deviation s > 0,
/// conditional on 1 + e > 0, where the logarithm exists, each within 1e-3 of its size. For small s
/// they are -s^2/2 and s; for large s the mean is ln s - (gamma + ln 2)/2 (gamma is Euler's
/// constant) and the standard deviation is pi/sqrt(8).
///
/// They are interpolated linearly over ln s in a table whose entries are computed on demand; beyond
/// its ends they follow the limits.
class LogarithmOfNoise {
 public:
  Estimate operator()(double s);

 private:
  // The range of ln s, and the number of entries for each unit of ln s.
  static constexpr double least = -7, most = 16, places = 32;
  Estimate at(std::size_t i);
  std::vector<Estimate> table_ =
      std::vector<Estimate>(static_cast<std::size_t>((most - least) * places) + 1);
};

}  // namespace rolling
