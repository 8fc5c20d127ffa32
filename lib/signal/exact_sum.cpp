// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/exact_sum.h"

#include <span>

namespace rolling {
namespace {

double quotient_of(std::span<const double> parts, std::size_t n) {
  DoubleDouble sum;
  for (std::size_t i = parts.size(); i-- > 0;) {
    const DoubleDouble next = two_sum(sum.hi, parts[i]);
    sum = {next.hi, sum.lo + next.lo};
  }
  sum = two_sum(sum.hi, sum.lo);
  // The rounding error of the quotient is corrected; the correction is so small that the rounding
  // of 1/n does not matter.
  const double count = static_cast<double>(n), inverse = 1 / count, quotient = sum.hi * inverse;
  return quotient + (std::fma(-quotient, count, sum.hi) + sum.lo) * inverse;
}

}  // namespace

double ExactSum::over(std::size_t n) const {
  if (large_.empty()) return negative_zeros_ == n ? -0.0 : quotient_of(parts_, n);
  // What 2^-100 takes from the other parts matters only where the large ones have cancelled.
  const bool is_large = std::abs(large_.back()) >= 0x1p900;
  Parts sum = is_large ? large_ : parts_;
  for (const double part : is_large ? parts_ : large_)
    grow(sum, part * (is_large ? 0x1p-100 : 0x1p100));
  return quotient_of(sum, n) * (is_large ? 0x1p100 : 1);
}

}  // namespace rolling
