// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/exact_sum.h"

namespace rolling {

double ExactSum::Parts::over(std::size_t n) const {
  DoubleDouble sum;
  for (std::size_t i = size; i-- > 0;) {
    const DoubleDouble next = two_sum(sum.hi, at[i]);
    sum = {next.hi, sum.lo + next.lo};
  }
  sum = two_sum(sum.hi, sum.lo);
  // The rounding error of the quotient is corrected; the correction is so small that the rounding
  // of 1/n does not matter.
  const double count = static_cast<double>(n), inverse = 1 / count, quotient = sum.hi * inverse;
  return quotient + (std::fma(-quotient, count, sum.hi) + sum.lo) * inverse;
}

double ExactSum::over(std::size_t n) const {
  if (large_.size == 0) return negative_zeros_ == n ? -0.0 : parts_.over(n);
  // What 2^-100 takes from the other parts matters only where the large ones have cancelled.
  const bool is_large = std::abs(large_.at[large_.size - 1]) >= 0x1p900;
  Parts sum = is_large ? large_ : parts_;
  const Parts& others = is_large ? parts_ : large_;
  for (std::size_t i = 0; i < others.size; ++i)
    sum.add(others.at[i] * (is_large ? 0x1p-100 : 0x1p100));
  return sum.over(n) * (is_large ? 0x1p100 : 1);
}

}  // namespace rolling
