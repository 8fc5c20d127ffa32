// SPDX-License-Identifier: GPL-3.0-or-later
// The mean and the median over a centred window, computed sample by sample. At the ends of a run
// the window shrinks symmetrically: the mean leaves a straight line unchanged, the median what only
// rises or falls.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "base/two_sum.h"
#include "signal/signal.h"

namespace rolling {

/// A sum of doubles without rounding error, from which terms can be subtracted again. After any
/// sequence of additions and subtractions it is the exact sum of the remaining terms; a moving sum
/// does not drift, and an outlier leaves no trace.
class ExactSum {
 public:
  void add(double y) { y == 0 ? add_zero(y, 1) : add_term(y); }
  void subtract(double y) { y == 0 ? add_zero(y, -1) : add_term(-y); }
  /// The sum divided by n, within 1 ulp of the exact quotient; -0 if all n terms are -0. n is 1 to
  /// 2^30.
  double over(std::size_t n) const {
    if (!large_.is_zero()) return over_with_large(n);
    return negative_zeros_ == n ? -0.0 : parts_.over(n);
  }

 private:
  double over_with_large(std::size_t n) const {
    // What 2^-100 takes from the other parts matters only where the large ones have cancelled.
    const bool is_large = std::abs(large_.at[large_.size - 1]) >= 0x1p900;
    Parts sum = is_large ? large_ : parts_;
    const Parts& others = is_large ? parts_ : large_;
    for (std::size_t i = 0; i < others.size; ++i)
      sum.add(others.at[i] * (is_large ? 0x1p-100 : 0x1p100));
    return sum.over(n) * (is_large ? 0x1p100 : 1);
  }
  /// Doubles whose digits do not overlap, the smallest first, each of the last two perhaps 0; their
  /// sum is exact (Shewchuk 1997, Discrete Comput. Geom. 18, 305). A column rarely needs a third.
  struct Parts {
    std::size_t size = 2;
    std::vector<double> at = std::vector<double>(4);  // with room behind them

    void add(double y) {
      if (size == at.size()) at.resize(2 * size);
      std::size_t left = 0;
      for (std::size_t i = 0; i + 1 < size; ++i) {
        const TwoSum sum = two_sum(y, at[i]);
        at[left] = sum.lo;
        left += sum.lo != 0;
        y = sum.hi;
      }
      const TwoSum sum = two_sum(y, at[size - 1]);
      at[left] = sum.lo;
      at[left + 1] = sum.hi;
      size = left + 2;
    }
    bool is_zero() const { return size == 2 && at[0] == 0 && at[1] == 0; }
    double over(std::size_t n) const {
      TwoSum sum = quick_two_sum(at[size - 1], at[size - 2]);
      for (std::size_t i = size - 2; i-- > 0;) {
        const TwoSum next = quick_two_sum(sum.hi, at[i]);
        sum = {next.hi, sum.lo + next.lo};
      }
      sum = quick_two_sum(sum.hi, sum.lo);
      // The rounding error of the quotient is corrected; the correction is so small that the
      // rounding of 1/n does not matter.
      const double count = static_cast<double>(n);
      const double inverse = 1 / count;
      const double quotient = sum.hi * inverse;
      return quotient + (std::fma(-quotient, count, sum.hi) + sum.lo) * inverse;
    }
  };
  void add_zero(double zero, int sign) {
    negative_zeros_ += static_cast<std::size_t>(std::signbit(zero) ? sign : 0);
  }
  void add_term(double y) {
    if (std::abs(y) < 0x1p900) parts_.add(y);
    else large_.add(y * 0x1p-100);
  }

  Parts parts_, large_;  // large_ holds terms whose sum could overflow, times 2^-100
  std::size_t negative_zeros_ = 0;
};

/// Each mean is within 1 ulp of the exact mean of its window, independent of earlier readings.
/// Throws Error for an even width.
inline std::unique_ptr<Signal> moving_mean(Width width) {
  const auto value = [sum = Sliding<ExactSum>()](const Windows& window) mutable {
    return sum.of(window).over(window.size());
  };
  return windowed(width, Windows::Ends::shrink, value);
}

/// Throws Error for an even width.
inline std::unique_ptr<Signal> moving_median(Width width) {
  const auto value = [sorted = Sliding<SortedWindow>()](const Windows& window) mutable {
    return sorted.of(window).median();
  };
  return windowed(width, Windows::Ends::shrink, value);
}

}  // namespace rolling
