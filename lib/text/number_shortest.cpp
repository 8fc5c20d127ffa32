// SPDX-License-Identifier: GPL-3.0-or-later
// The digits are found as in Schubfach (R. Giulietti, The Schubfach way to render doubles, 2020),
// with one product in place of three (as in Y. Guo's yy_double).
//
// A double is c 2^q. In units of 10^k with 10^k <= 2^q < 10^(k+1), the distance u to the next
// double is from 1 to 10, and every number within u/2 reads back to the same double. So the
// shortest such number is the multiple of ten within u/2, of which there is at most one, or else
// the nearest whole number. Where the product is too coarse to tell, one case in 2^50 or so, fmt
// decides.
#include "text/number.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace rolling {
namespace {

__extension__ using Wide = unsigned __int128;

// The powers of ten that are needed: 10^-k for q = 971 and q = -1074.
constexpr int least_power = -292, greatest_power = 324;

/// The highest 128 bits of a power of ten, the rest cut off.
struct Power {
  std::uint64_t high, low;
};

/// Computes the powers from the greatest one by repeated division in 256 bits. Each of the 616
/// steps truncates less than 2^-254 of the number; the first one is too large by 2^-246 of it, so
/// that the exact ones do not fall below themselves. More than 240 bits remain correct.
constexpr auto powers_of_ten = [] {
  std::array<Power, greatest_power - least_power + 1> powers{};
  // The highest bits of 5^324, plus 1024; the lowest 64 first.
  std::array<std::uint64_t, 4> x = {0xaefc86c50710d1c9, 0x4944d9f52cd0dec2, 0x6c07a2c26a8346d1,
                                    0x9e19db92b4e31ba9};
  for (std::size_t n = powers.size(); n-- > 0;) {
    powers[n] = {x[3], x[2]};
    std::uint64_t rest = 0;
    for (std::size_t i = 4; i-- > 0;) {
      const Wide part = Wide{rest} << 64 | x[i];
      x[i] = static_cast<std::uint64_t>(part / 5);
      rest = static_cast<std::uint64_t>(part % 5);
    }
    const int bits = std::countl_zero(x[3]);  // 2 or 3: the highest bit is set again
    for (std::size_t i = 3; i > 0; --i) x[i] = x[i] << bits | x[i - 1] >> (64 - bits);
    x[0] <<= bits;
  }
  return powers;
}();

/// The decimal digits 10^exponent: 17 digits, including zeros at the end. digits = 0 if the method
/// cannot decide.
struct Decimal {
  std::uint64_t digits;
  int exponent;
};

Decimal shortest_decimal(std::uint64_t bits) {
  constexpr std::uint64_t hidden = std::uint64_t{1} << 52;
  const std::uint64_t fraction = bits & (hidden - 1);
  const int biased = static_cast<int>(bits >> 52 & 0x7ff);
  // 0 and denormals have fewer digits; a power of two is nearer to the double below it.
  if (biased == 0 || fraction == 0) return {};
  const int q = biased - 1075, k = q * 315653 >> 20;  // floor(q log10(2))
  const Power& power = powers_of_ten[static_cast<std::size_t>(-k - least_power)];
  // power stands for 10^-k = power 2^(floor(-k log2(10)) - 127), so that c 2^q 10^-k is the product
  // below divided by 2^64. The shift is from 1 to 4.
  const int shift = q + (-k * 1741647 >> 19) + 1;
  const std::uint64_t c = (fraction | hidden) << shift;
  // cppcheck-suppress shiftTooManyBits  ; a Wide has 128
  const Wide product = Wide{c} * power.high + static_cast<std::uint64_t>(Wide{c} * power.low >> 64);
  const auto whole = static_cast<std::uint64_t>(product >> 64);
  const auto part = static_cast<std::uint64_t>(product);

  constexpr std::uint64_t half = (std::uint64_t{1} << 63) - 64;  // between two whole numbers
  // In units of 2^-60, each less than 2 too small or too great.
  constexpr std::uint64_t doubt = 4, ten = 10 * (std::uint64_t{1} << 60);
  const std::uint64_t half_step = power.high >> (5 - shift), tens = whole / 10,
                      above = ((whole - 10 * tens) << 60) + (part >> 4), below = ten - above;
  std::uint64_t digits;
  if (above + doubt < half_step) digits = 10 * tens;
  else if (below + doubt < half_step) digits = 10 * tens + 10;
  else if (above <= half_step + doubt || below <= half_step + doubt || part - half < 128) return {};
  else digits = whole + (part >> 63);
  const bool sixteen = digits < 10000000000000000;
  return sixteen ? Decimal{10 * digits, k - 1} : Decimal{digits, k};
}

/// Eight decimal digits as bytes of one word, the first one lowest; `number` is below 10^8.
std::uint64_t eight_digits(std::uint64_t number) {
  std::uint64_t word = number / 10000 | number % 10000 << 32;
  std::uint64_t tens = word * 5243 >> 19 & 0x0000007f0000007f;  // / 100
  word = tens | (word - 100 * tens) << 16;
  tens = word * 103 >> 10 & 0x000f000f000f000f;  // / 10
  return tens | (word - 10 * tens) << 8;
}

/// Writes eight digits as text.
void write_eight(char* to, std::uint64_t digits) {
  digits += 0x3030303030303030;
  if constexpr (std::endian::native == std::endian::big) digits = __builtin_bswap64(digits);
  std::memcpy(to, &digits, sizeof digits);
}

}  // namespace

char* write_shortest(char* to, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const Decimal decimal = shortest_decimal(bits);
  *to = '-';
  to += bits >> 63;
  if (decimal.digits == 0) {
    if (value == 0) return *to = '0', to + 1;
    const std::string text = fmt::format("{}", std::abs(value));
    return std::copy(text.begin(), text.end(), to);
  }
  const std::uint64_t nine = decimal.digits / 100000000, first = nine / 100000000,
                      middle = eight_digits(nine - 100000000 * first),
                      last = eight_digits(decimal.digits - 100000000 * nine);
  const int count = last     ? 17 - std::countl_zero(last) / 8
                    : middle ? 9 - std::countl_zero(middle) / 8
                             : 1;           // without the zeros at the end
  const int point = decimal.exponent + 17;  // it stands behind so many digits
  const bool scientific = point < -3 || point > 16;
  const int before = scientific ? 1 : point;  // so many digits stand before it
  std::string_view("0.000").copy(to, 5);
  char* const digits = before > 0 ? to + 1 : to + 2 - before;
  digits[0] = static_cast<char>('0' + first);
  write_eight(digits + 1, middle);
  write_eight(digits + 9, last);
  if (before <= 0) return digits + count;
  std::memmove(to, digits, static_cast<std::size_t>(before));
  to[before] = '.';
  to += count > before ? count + 1 : before;
  if (!scientific) return to;
  const int exponent = std::abs(point - 1);
  *to++ = 'e';
  *to++ = point < 1 ? '-' : '+';
  if (exponent < 10) *to++ = '0';
  return std::to_chars(to, to + 3, exponent).ptr;
}

}  // namespace rolling
