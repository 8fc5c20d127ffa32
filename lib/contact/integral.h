// SPDX-License-Identifier: GPL-3.0-or-later
// The running integral of a column over time.
#pragma once

#include "base/double_double.h"

namespace rolling {

/// Each step is integrated under the parabola through its two samples and the one before (the
/// third-order rule of Adams and Moulton on uneven times): the error is of third order in the
/// spacing. The trapezoidal rule replaces it where the parabola would be wrong: for the first step,
/// for a step much longer than the one before, and for a step from or to a sample of exactly 0,
/// which is rest: the power has a corner there.
class Integral {
 public:
  /// Adds the next sample (times increase) and returns the integral from the first sample to this
  /// one. The sum is compensated (Neumaier), so rounding errors do not accumulate in long runs.
  double push(double t, double y) {
    if (begun_) {
      const double h = t - t_, k = last_step_, rise = y - y_;
      double part = 0.5 * h * (y + y_);
      if (h <= most_times * k && y != 0 && y_ != 0)
        part -= h * h / (6 * (h + k) * k) * (rise * k - last_rise_ * h);
      const DoubleDouble sum = two_sum(sum_, part);
      sum_ = sum.hi, error_ += sum.lo;
      last_step_ = h, last_rise_ = rise;
    }
    begun_ = true;
    t_ = t, y_ = y;
    return sum_ + error_;
  }

 private:
  /// The limit lies between whole numbers, which are the ratios of the steps where rows are
  /// lost: no rounding of the times decides.
  static constexpr double most_times = 2.5;

  bool begun_ = false;
  double t_ = 0, y_ = 0;
  double last_step_ = 0, last_rise_ = 0;  // of t and of y; 0 before the first step
  double sum_ = 0, error_ = 0;
};

}  // namespace rolling
