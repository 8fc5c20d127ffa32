// A sum of doubles without rounding, from which terms can be taken away again: after any history of
// additions and subtractions it is what the terms still in it add up to. So a moving sum cannot
// drift, and an outlier leaves no trace.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/double_double.h"

namespace rolling {

class ExactSum {
 public:
  void add(double y) { y == 0 ? add_zero(y, 1) : add_term(y); }
  void subtract(double y) { y == 0 ? add_zero(y, -1) : add_term(-y); }
  /// Adds one term and subtracts another.
  void exchange(double y, double old) {
    const DoubleDouble change = two_sum(y, -old);  // mostly exact, of neighbours in a column
    if (change.lo == 0 && y != 0 && old != 0) return add_term(change.hi);
    add(y);
    subtract(old);
  }
  /// Sum / n, within 1 ulp of the exact quotient; -0 if all of n terms are -0. At most 2^30 terms;
  /// n > 0.
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

  // The sum is that of pair_, which holds readings of one instrument exactly, and of the limbs for
  // what it cannot hold: a fixed-point number of 2^-1074, in overlapping limbs 32 bits apart. A
  // term goes whole into the one where it begins, which has room for 2^43 of them; no carries while
  // adding (after Kulisch's long accumulator).
  DoubleDouble pair_;
  static constexpr std::size_t limbs = 64;
  std::array<int128, limbs> limb_{};
  std::size_t low_ = limbs, high_ = 0;  // limbs outside [low_, high_) are 0
  std::size_t negative_zeros_ = 0;
};

}  // namespace rolling
