// SPDX-License-Identifier: GPL-3.0-or-later
// Exact arithmetic on doubles, to judge sums and means by: a fixed-point number of as many digits
// as all doubles need, after Kulisch's long accumulator. Not the method of lib/signal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace rolling {

/// Sum of doubles without rounding.
class FixedPoint {
 public:
  void add(double y) { add_product(1, y); }
  /// Adds n y, for a whole number n below 2^31.
  void add_product(double n, double y) {
    int exponent;
    const double mantissa = std::frexp(y, &exponent);
    // y = m 2^(place - unit)
    const int place = std::max(exponent - 53 + unit, 0);
    const auto m = static_cast<std::int64_t>(std::ldexp(mantissa, exponent + unit - place));
    digit_[static_cast<std::size_t>(place / 32)] +=
        static_cast<Wide>(m) * static_cast<std::int64_t>(n) << place % 32;
  }
  int sign() const {
    const auto digit = carried();
    if (digit.back() < 0) return -1;
    for (const Wide d : digit)
      if (d != 0) return 1;
    return 0;
  }
  double nearly() const {
    FixedPoint size = *this;
    const int s = sign();
    for (Wide& d : size.digit_) d *= s;
    double sum = 0;
    int place = -unit;
    for (const Wide d : size.carried())
      sum += std::ldexp(static_cast<double>(d), place), place += 32;
    return s * sum;
  }

 private:
  __extension__ typedef __int128 Wide;
  using Digits = std::array<Wide, 72>;  // of 32 bits each, with room for what is not carried yet
  static constexpr int unit = 1074;     // the last place is 2^-1074

  /// All digits but the last are 0 to 2^32 - 1; the last has the sign.
  Digits carried() const {
    Digits digit = digit_;
    for (std::size_t i = 0; i + 1 < digit.size(); ++i) {
      digit[i + 1] += digit[i] >> 32;
      digit[i] &= 0xffffffff;
    }
    return digit;
  }

  Digits digit_{};
};

/// Is `mean` within one ulp of the exact mean of `values`? `scale` is a power of two that keeps
/// them all within range.
inline bool within_one_ulp(std::span<const double> values, double mean, double scale = 1) {
  const double up = std::nextafter(mean, std::numeric_limits<double>::infinity());
  const double down = std::nextafter(mean, -std::numeric_limits<double>::infinity());
  const auto side = [&](double bound) {  // sign of sum - n bound
    FixedPoint difference;
    for (const double y : values) difference.add(y * scale);
    difference.add_product(-static_cast<double>(values.size()), bound * scale);
    return difference.sign();
  };
  return std::isfinite(mean) && side(up) <= 0 && side(down) >= 0;
}

}  // namespace rolling
