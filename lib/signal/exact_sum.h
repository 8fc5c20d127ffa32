// SPDX-License-Identifier: GPL-3.0-or-later
// A sum of doubles without rounding error, from which terms can be subtracted again. After any
// sequence of additions and subtractions it is the exact sum of the remaining terms; a moving sum
// does not drift, and an outlier leaves no trace.
#pragma once

#include <array>
#include <cstddef>

#include "base/double_double.h"

namespace rolling {

class ExactSum {
 public:
  void add(double y) { y == 0 ? add_zero(y, 1) : add_term(y); }
  void subtract(double y) { y == 0 ? add_zero(y, -1) : add_term(-y); }
  /// Adds y and subtracts `old`.
  void exchange(double y, double old) {
    const DoubleDouble change = two_sum(y, -old);  // usually exact for neighbours in a column
    if (change.lo == 0 && y != 0 && old != 0) return add_term(change.hi);
    add(y);
    subtract(old);
  }
  /// The sum divided by n, within 1 ulp of the exact quotient; -0 if all n terms are -0. n is 1 to
  /// 2^30.
  double over(std::size_t n);

 private:
  __extension__ typedef __int128 int128;

  void add_zero(double zero, int sign);
  void add_term(double y) {
    const DoubleDouble high = two_sum(pair_.hi, y), low = two_sum(pair_.lo, high.lo);
    if (low.lo != 0) return add_beyond(y, high.hi, low);  // NaN too
    pair_ = {high.hi, low.hi};
  }
  void add_beyond(double y, double high, DoubleDouble low);
  void to_limbs(double y);
  double limbs_over(std::size_t n);

  // The sum has two parts. pair_ holds sums of ordinary readings exactly. limb_ holds what pair_
  // cannot: a fixed-point number with the unit 2^-1074 in overlapping limbs 32 bits apart. A term
  // is added as a whole to the limb in which it begins, without carries; a limb has room for 2^43
  // terms (after Kulisch's long accumulator).
  DoubleDouble pair_;
  static constexpr std::size_t limbs = 64;
  std::array<int128, limbs> limb_{};
  std::size_t low_ = limbs, high_ = 0;  // limbs outside [low_, high_) are 0
  std::size_t negative_zeros_ = 0;
};

}  // namespace rolling
