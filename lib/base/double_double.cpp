// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/double_double.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace rolling {

namespace {

/// ln((1 + z)/(1 - z)) = 2 artanh z, |z| < 1/5.
constexpr DoubleDouble twice_artanh(DoubleDouble z) {
  const DoubleDouble square = z * z;
  DoubleDouble sum = 0.0;
  for (int n = 49; n > 0; n -= 2) sum = sum * square + DoubleDouble(1) / n;
  return sum * z * 2;
}

/// e^x for |x| < 1/2.
constexpr DoubleDouble exp_series(DoubleDouble x) {
  DoubleDouble sum = 1;
  for (int n = 28; n > 0; --n) sum = sum * x / n + 1;
  return sum;
}

constexpr DoubleDouble ln2 =
    twice_artanh(DoubleDouble(1) / 7) * 2 + twice_artanh(DoubleDouble(1) / 17);  // 2 = (4/3)^2 9/8

// x = 2^k m, and ln x = k ln2 + ln c + ln(m/c). The range of m is divided into intervals; 1/c is
// the number of 9 bits nearest to the inverse of the middle of the interval.
constexpr int log_bits = 7, log_size = 1 << log_bits;
constexpr std::uint64_t log_offset = 0x3fe6a00000000000;  // m from 0.707 to 1.414

/// Rounds hi to a multiple of 2^-42; lo is the remainder. Sums of such multiples are exact below
/// 1024.
constexpr DoubleDouble coarse(DoubleDouble x) {
  const double top = static_cast<double>(static_cast<std::int64_t>(x.hi * 0x1p42)) * 0x1p-42;
  return {top, (x.hi - top) + x.lo};
}
constexpr DoubleDouble log_2 = coarse(ln2);

struct LogEntry {
  double inverse;    // 1/c, a multiple of 2^-9
  DoubleDouble log;  // coarse
};
constexpr auto log_table = [] {
  std::array<LogEntry, log_size> table{};
  for (std::size_t i = 0; i < log_size; ++i) {
    const std::uint64_t begin = (log_offset & ~((1ull << 45) - 1)) + (i << 45),
                        end = begin + (1ull << 45);
    const double middle = (std::bit_cast<double>(begin) + std::bit_cast<double>(end)) / 2;
    // 512 / middle is between 256 and 1024: no rounding goes wrong there, and lround, which is
    // proposed instead, is not constexpr.
    // NOLINTNEXTLINE(bugprone-incorrect-roundings)
    const double inverse = static_cast<double>(static_cast<int>(512 / middle + 0.5)) / 512;
    table[i] = {inverse, coarse(twice_artanh(DoubleDouble(1 - inverse) / (1 + inverse)))};
  }
  return table;
}();

// e^x = 2^(n/128) e^r. hi of each power keeps 26 bits; lo is the remainder. The products that lead
// from one power to the next add up to a relative error below 2^-95.
constexpr int exp_bits = 7, exp_size = 1 << exp_bits;
constexpr auto exp_table = [] {
  std::array<DoubleDouble, exp_size> table{};
  const DoubleDouble ratio = exp_series(ln2 / exp_size);
  DoubleDouble power = 1;
  for (auto& entry : table) {
    const double hi = split(power.hi).hi;  // 26 bits: its products with 26 bits are exact
    entry = {hi, (power.hi - hi) + power.lo};
    power = power * ratio;
  }
  return table;
}();

constexpr double step1 = cut(ln2.hi / exp_size, 21),
                 step2 = (ln2.hi / exp_size - step1) + ln2.lo / exp_size;  // n step1 is exact

/// ln(1 + x) - x + x^2/2
double log1p_cubic(double x) {
  const double x2 = x * x;
  return x * x2 *
         ((1. / 3 - x * (1. / 4)) +
          x2 * ((1. / 5 - x * (1. / 6)) + x2 * ((1. / 7 - x * (1. / 8)) + x2 * (1. / 9))));
}

/// e^x = 2^(n/128) (1 + expm1).
struct Reduced {
  int n;
  double expm1;
  const DoubleDouble& power() const { return exp_table[static_cast<std::size_t>(n) % exp_size]; }
  int exponent() const { return n >> exp_bits; }
};

Reduced reduce(DoubleDouble x) {
  constexpr double rounder = 0x1.8p52;
  const double n = (x.hi * (exp_size / ln2.hi) + rounder) - rounder;
  const double r = (x.hi - n * step1) + (x.lo - n * step2), r2 = r * r;
  return {static_cast<int>(n),
          r + r2 * ((1. / 2 + r * (1. / 6)) + r2 * (1. / 24 + r * (1. / 120)))};
}

}  // namespace

DoubleDouble exp(DoubleDouble x) {
  const double n = std::round(x.hi / ln2.hi);
  const DoubleDouble series = exp_series(x - ln2 * n);
  const int half = static_cast<int>(n / 2), other = static_cast<int>(n) - half;
  return {std::ldexp(std::ldexp(series.hi, half), other),
          std::ldexp(std::ldexp(series.lo, half), other)};
}

DoubleDouble log(DoubleDouble x) {
  int k = 0;
  const double m = std::frexp(x.hi, &k);
  const DoubleDouble mantissa(m, std::ldexp(x.lo, -k));
  const DoubleDouble first = std::log(m);  // one step of Newton's method follows
  return first + (mantissa * exp(-first) - 1.0) + ln2 * static_cast<double>(k);
}

DoubleDouble log1p_ratio(DoubleDouble r) {
  const DoubleDouble line = quick_two_sum(1, -r.hi / 2);
  return quick_two_sum(line.hi, line.lo + (r.hi == 0 ? 0 : log1p_cubic(r.hi) / r.hi) - r.lo / 2);
}

DoubleDouble quick_log(DoubleDouble x) {
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x.hi), above = bits - log_offset;
  const int k = static_cast<int>(static_cast<std::int64_t>(above) >> 52);
  const auto& [inverse, log_c] = log_table[(above >> (52 - log_bits)) % log_size];
  const double m = std::bit_cast<double>(bits - (static_cast<std::uint64_t>(k) << 52)),
               top = cut(m, 32);
  // m/c - 1 = r1 + r2 and ln(1 + r) = r - r^2/2 + cubic. These are exact: r1 (23 bits) and its
  // square, r2, k log_2.hi + ln c + r1, and r2 - r1^2/2.
  const double r1 = top * inverse - 1, r2 = (m - top) * inverse, r = r1 + r2;
  const DoubleDouble sum = quick_two_sum(k * log_2.hi + log_c.hi + r1, r2 - r1 * r1 / 2);
  return {sum.hi, sum.lo + (x.lo / x.hi + (k * log_2.lo + log_c.lo) +
                            (log1p_cubic(r) - r2 * (r1 + r) / 2))};
}

double times_exp(DoubleDouble f, DoubleDouble x) {
  const Reduced e = reduce(x);
  const auto [hi, lo] = quick_product(f, e.power());
  const double m = hi + (lo + (hi + lo) * e.expm1);  // rounded once but for the denormals
  const int n = e.exponent();
  return n > -1000 && n < 1000 ? m * power_of_two(n) : std::ldexp(m, n);
}

DoubleDouble one_minus_exp(DoubleDouble x) {
  const Reduced e = reduce(x);
  const DoubleDouble& power = e.power();
  const double unit = power_of_two(std::clamp(e.exponent(), -1022, 1023));
  const DoubleDouble sum = two_sum(1, -power.hi * unit);
  return quick_two_sum(sum.hi, sum.lo - (power.lo + (power.hi + power.lo) * e.expm1) * unit);
}

DoubleDouble expm1_ratio(DoubleDouble x) {
  double sum = 0;
  for (int n = 9; n > 1; --n)
    sum = (sum * (x.hi + x.lo) + 1) / n;  // (e^x - 1)/x - 1 = x/2 (1 + x/3 (1 + ...)), over x
  return quick_two_sum(1, sum * (x.hi + x.lo));
}

}  // namespace rolling
