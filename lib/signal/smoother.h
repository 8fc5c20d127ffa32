// SPDX-License-Identifier: GPL-3.0-or-later
// Smoothing of a column, sample by sample.
#pragma once

#include <span>

#include "signal/method.h"

namespace rolling {

/// The methods mean, median and savgol; all have a width.
extern const std::span<const SignalMethod> smoothing_methods;

}  // namespace rolling
