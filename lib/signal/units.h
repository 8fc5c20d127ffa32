// SPDX-License-Identifier: GPL-3.0-or-later
// Units in which the readings of a run and its duration are of order one.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "signal/windows.h"

namespace rolling {

/// A computation that takes squares of readings or times first changes to these units: no square
/// overflows or underflows then. Both units are powers of two, so the change does not round.
struct Units {
  int t = 0, y = 0;  ///< the exponents of 2

  explicit Units(std::span<const Sample> run) {
    double largest = 0;
    for (const Sample& s : run) largest = std::max(largest, std::abs(s.y));
    if (largest > 0) y = std::ilogb(largest);
    if (run.size() > 1) t = std::ilogb(run.back().t - run.front().t);
  }
  Sample operator()(const Sample& s) const { return {std::ldexp(s.t, -t), std::ldexp(s.y, -y)}; }
};

}  // namespace rolling
