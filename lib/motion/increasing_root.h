// SPDX-License-Identifier: GPL-3.0-or-later
// The root of an increasing function of one variable, by Newton's method within a bracket.
#pragma once

#include <cmath>

namespace rolling {

/// Root between lo and hi of an increasing function: Newton's method from x, bisection where that
/// leaves the bracket. `function` returns value and slope. At most 200 evaluations.
template <typename Function>
double increasing_root(double lo, double hi, double x, Function&& function) {
  const double least = 1e-9 * (hi - lo);
  for (int i = 0; i < 200; ++i) {
    const auto [value, slope] = function(x);
    (value < 0 ? lo : hi) = x;
    double next = x - value / slope;
    if (!(next >= lo && next <= hi)) next = lo + (hi - lo) / 2;
    const double step = std::abs(next - x);
    x = next;
    if (step <= least) break;  // convergence is quadratic
  }
  return x;
}

}  // namespace rolling
