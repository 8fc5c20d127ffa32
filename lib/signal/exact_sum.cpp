#include "signal/exact_sum.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rolling {
namespace {
__extension__ typedef unsigned __int128 uint128;
}

void ExactSum::accumulate(double y, std::int64_t sign) {
  const auto bits = std::bit_cast<std::uint64_t>(y);
  const auto exponent = static_cast<unsigned>(bits >> 52 & 0x7ff);
  std::uint64_t mantissa = bits & 0xfffffffffffffULL;
  if (exponent) mantissa |= 1ULL << 52;
  if (bits >> 63) sign = -sign;
  const unsigned position = exponent ? exponent - 1 : 0;  // y = mantissa * 2^(position - 1074)
  const std::size_t at = position / 32;
  const auto shifted = static_cast<uint128>(mantissa) << position % 32;
  limb_[at] += sign * static_cast<std::int64_t>(shifted & 0xffffffffU);
  limb_[at + 1] += sign * static_cast<std::int64_t>(shifted >> 32 & 0xffffffffU);
  limb_[at + 2] += sign * static_cast<std::int64_t>(shifted >> 64);
  low_ = std::min(low_, at);
  high_ = std::max(high_, at + 3);
}

double ExactSum::over(std::size_t n) {
  while (high_ > low_ && limb_[high_ - 1] == 0) --high_;
  while (high_ > low_ && limb_[low_] == 0) ++low_;
  if (high_ == low_) {
    low_ = limbs, high_ = 0;
    return 0;
  }
  // Carries, into digits of 32 bits and a sign.
  std::array<std::uint32_t, limbs + 1> digit;
  const auto carry_through = [&](std::int64_t sign) {
    std::int64_t carry = 0;
    for (std::size_t i = low_; i < high_; ++i) {
      const std::int64_t sum = sign * limb_[i] + carry;
      digit[i] = static_cast<std::uint32_t>(sum);
      carry = sum >> 32;
    }
    return carry;
  };
  double sign = 1;
  std::int64_t carry = carry_through(1);
  if (carry < 0) carry = carry_through(-1), sign = -1;
  digit[high_] = static_cast<std::uint32_t>(carry);

  std::size_t top = high_;
  while (top > low_ && digit[top] == 0) --top;
  // The four leading digits are at least 97 bits of the sum; the rest is below 2^-96 of it. Their last bit goes to make room
  // for rounding up.
  uint128 leading = 0;
  for (std::size_t k = 0; k < 4; ++k) leading = leading << 32 | (top >= low_ + k ? digit[top - k] : 0);
  leading >>= 1;
  const auto high = static_cast<double>(leading);
  const auto rounded = static_cast<uint128>(high);
  const double low = leading >= rounded ? static_cast<double>(leading - rounded) : -static_cast<double>(rounded - leading);
  const auto count = static_cast<double>(n);
  const double quotient = high / count;
  const double rest = (std::fma(-quotient, count, high) + low) / count;
  return std::ldexp(sign * (quotient + rest), 32 * (static_cast<int>(top) - 3) - 1073);
}

}  // namespace rolling
