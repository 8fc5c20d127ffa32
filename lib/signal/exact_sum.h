// SPDX-License-Identifier: GPL-3.0-or-later
// A sum of doubles without rounding error, from which terms can be subtracted again. After any
// sequence of additions and subtractions it is the exact sum of the remaining terms; a moving sum
// does not drift, and an outlier leaves no trace.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "base/double_double.h"

namespace rolling {

class ExactSum {
 public:
  void add(double y) {
    std::size_t left = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const DoubleDouble sum = two_sum(y, parts_[i]);
      if (sum.lo != 0) parts_[left++] = sum.lo;
      y = sum.hi;
    }
    parts_.resize(left);
    if (y != 0) parts_.push_back(y);
  }
  /// Adds y and subtracts `old`.
  void exchange(double y, double old) {
    const DoubleDouble change = two_sum(y, -old);  // usually exact for neighbours in a column
    if (change.lo == 0) return add(change.hi);
    add(-old);
    add(y);
  }
  /// The sum divided by n, within 1 ulp of the exact quotient; n is 1 to 2^30. Not finite where a
  /// sum was beyond the range of a double.
  double over(std::size_t n) const {
    DoubleDouble sum;
    for (std::size_t i = parts_.size(); i-- > 0;) {
      const DoubleDouble next = two_sum(sum.hi, parts_[i]);
      sum = {next.hi, sum.lo + next.lo};
    }
    sum = two_sum(sum.hi, sum.lo);
    // The rounding error of the quotient is corrected; the correction is so small that the rounding
    // of 1/n does not matter.
    const double count = static_cast<double>(n), inverse = 1 / count, quotient = sum.hi * inverse;
    return quotient + (std::fma(-quotient, count, sum.hi) + sum.lo) * inverse;
  }

 private:
  /// Doubles whose digits do not overlap, the smallest first; their sum is exact (Shewchuk 1997,
  /// Discrete Comput. Geom. 18, 305).
  std::vector<double> parts_;
};

}  // namespace rolling
