// SPDX-License-Identifier: GPL-3.0-or-later
// The largest value of a function of one variable with a single maximum.
#pragma once

#include <utility>

namespace rolling {

struct Largest {
  double at, value;
};

/// Golden-section search on [low, high]; the interval at the end is at most `width` wide.
template <typename Function>
Largest golden_section(double low, double high, double width, Function&& f) {
  constexpr double golden = 0.6180339887498949;  // (sqrt(5) - 1) / 2
  double left = high - golden * (high - low);
  double right = low + golden * (high - low);
  double at_left = f(left);
  double at_right = f(right);
  while (high - low > width) {
    if (at_left > at_right) {
      high = std::exchange(right, left);
      at_right = std::exchange(at_left, f(left = high - golden * (high - low)));
    } else {
      low = std::exchange(left, right);
      at_left = std::exchange(at_right, f(right = low + golden * (high - low)));
    }
  }
  return at_left > at_right ? Largest{left, at_left} : Largest{right, at_right};
}

}  // namespace rolling
