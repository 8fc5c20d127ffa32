// SPDX-License-Identifier: GPL-3.0-or-later
// The logarithm of a number with normal noise.
#pragma once

#include "base/estimate.h"

namespace rolling {

/// The mean and the standard deviation of ln(1 + e) for normal e of standard deviation s > 0,
/// conditional on 1 + e > 0, where the logarithm exists, each within 1e-3 of its size. For small s
/// they are -s^2/2 and s; for large s the mean is ln s - (gamma + ln 2)/2 (gamma is Euler's
/// constant) and the standard deviation is pi/sqrt(8).
Estimate logarithm_of_noise(double s);

}  // namespace rolling
