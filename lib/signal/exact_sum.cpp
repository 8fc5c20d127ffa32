// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/exact_sum.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace rolling {

void ExactSum::add_zero(double zero, int sign) {
  negative_zeros_ += static_cast<std::size_t>(std::signbit(zero) ? sign : 0);
}

/// The part of add_term() for sums that pair_ cannot hold exactly.
void ExactSum::add_beyond(double y, double high, DoubleDouble low) {
  if (!std::isfinite(low.lo)) return to_limbs(y);  // an intermediate sum overflowed
  pair_ = {high, low.hi};
  to_limbs(low.lo);
}

void ExactSum::to_limbs(double y) {
  if (y == 0) return;
  const auto bits = std::bit_cast<std::uint64_t>(y);
  const auto exponent = static_cast<unsigned>(bits >> 52 & 0x7ff);
  const auto mantissa =
      static_cast<std::int64_t>((bits & 0xfffffffffffffULL) | (exponent ? 1ULL << 52 : 0));
  const unsigned position = exponent ? exponent - 1 : 0;  // |y| = mantissa * 2^(position - 1074)
  const std::size_t at = position / 32;
  const int128 term = static_cast<int128>(mantissa) << position % 32;
  limb_[at] += std::signbit(y) ? -term : term;
  low_ = std::min(low_, at);
  high_ = std::max(high_, at + 1);
}

double ExactSum::over(std::size_t n) {
  if (low_ < high_) {
    to_limbs(pair_.hi);
    to_limbs(pair_.lo);
    pair_ = {};
    return limbs_over(n);
  }
  pair_ = two_sum(pair_.hi, pair_.lo);
  if (pair_.hi == 0) return negative_zeros_ == n ? -0.0 : 0;
  // The rounding error of the quotient is corrected; the correction is so small that the rounding
  // of 1/n does not matter.
  const double count = static_cast<double>(n), inverse = 1 / count, quotient = pair_.hi * inverse;
  return quotient + (std::fma(-quotient, count, pair_.hi) + pair_.lo) * inverse;
}

double ExactSum::limbs_over(std::size_t n) {
  while (high_ > low_ && limb_[high_ - 1] == 0) --high_;
  while (high_ > low_ && limb_[low_] == 0) ++low_;

  // After the carries, `digit` holds digits of 32 bits and `sum` the part above them, with the
  // sign.
  std::array<std::uint32_t, limbs> digit;
  int128 sum = 0;
  std::uint32_t any = 0;
  for (std::size_t i = low_; i < high_; ++i) {
    sum += limb_[i];
    any |= digit[i] = static_cast<std::uint32_t>(sum);
    sum >>= 32;
  }
  if (sum == 0 && any == 0) {
    low_ = limbs, high_ = 0;
    return negative_zeros_ == n ? -0.0 : 0;
  }
  // The leading digits are moved to `sum` until 2^73 <= |sum| < 2^105. The other digits are then
  // below 2^-73 of it, and both halves of `sum` are exact doubles.
  std::size_t at = high_;
  int scale = 32 * static_cast<int>(high_) - 1074;
  for (; sum >> 73 == sum >> 127; scale -= 32) sum = sum << 32 | (at > low_ ? digit[--at] : 0);
  const auto leading = static_cast<std::int64_t>((sum + (1LL << 51)) >> 52);
  const double high = static_cast<double>(leading) * 0x1p52;
  const auto low =
      static_cast<double>(static_cast<std::int64_t>(sum - (static_cast<int128>(leading) << 52)));
  // `rest` is below 2^-20 of the quotient, so that the rounding of 1/n does not matter.
  const double count = static_cast<double>(n), quotient = high / count, inverse = 1 / count;
  const double rest = (std::fma(-quotient, count, high) + low) * inverse;
  return (quotient + rest) * power_of_two(scale / 2) *
         power_of_two(scale - scale / 2);  // scale is -1170 to 1000: at most one rounding
}

}  // namespace rolling
