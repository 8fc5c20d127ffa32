// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of about 106 bits as an unevaluated sum of two doubles, and the logarithm and exponential
// that the closed form needs.
//
// The sums and products are those of Dekker (1971) and Knuth. The product splits its factors and
// does not call std::fma, which without -mfma is a call of libm for each product and cannot make
// tables at compile time.
#pragma once

#include <bit>
#include <cfloat>
#include <cstdint>

#if defined __FAST_MATH__ || defined __ASSOCIATIVE_MATH__ || __FINITE_MATH_ONLY__
#error "rolling rests on exact sums and products of doubles: build it without -ffast-math"
#endif
#if FLT_EVAL_METHOD != 0
#error "rolling rests on sums and products rounded to double: on x87 add -msse2 -mfpmath=sse"
#endif

namespace rolling {

/// The number hi + lo, with |lo| <= ulp(hi)/2 unless a function states another bound. Its magnitude
/// must be within 1e-290 .. 1e290, because products split their factors.
struct DoubleDouble {
  double hi = 0, lo = 0;

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double x) : hi(x) {}
  constexpr DoubleDouble(double high, double low) : hi(high), lo(low) {}
  constexpr DoubleDouble operator-() const { return {-hi, -lo}; }
};

/// 2^n for -1022 <= n <= 1023.
constexpr double power_of_two(int n) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52);
}

constexpr DoubleDouble two_sum(double a, double b) {
  const double sum = a + b, of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}

/// a + b for |a| >= |b|.
constexpr DoubleDouble quick_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// Splits a into two parts of 26 bits, whose products with such parts are exact (Dekker).
constexpr DoubleDouble split(double a) {
  const double c = 134217729 * a, hi = c - (c - a);
  return {hi, a - hi};
}

/// a b, exactly.
constexpr DoubleDouble two_product(double a, double b) {
  const double p = a * b;
  const auto [a1, a2] = split(a);
  const auto [b1, b2] = split(b);
  return {p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2};
}

constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble s = two_sum(a.hi, b.hi), t = two_sum(a.lo, b.lo),
                     u = quick_two_sum(s.hi, s.lo + t.hi);
  return quick_two_sum(u.hi, u.lo + t.lo);
}
constexpr DoubleDouble operator+(DoubleDouble a, double b) {
  const DoubleDouble s = two_sum(a.hi, b);
  return quick_two_sum(s.hi, s.lo + a.lo);
}
constexpr DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + -b; }

constexpr DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble p = two_product(a.hi, b.hi);
  return quick_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

constexpr DoubleDouble operator*(DoubleDouble a, double b) {
  const DoubleDouble p = two_product(a.hi, b);
  return quick_two_sum(p.hi, p.lo + a.lo * b);
}

constexpr DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double q1 = a.hi / b.hi;
  const DoubleDouble r = a - b * q1;
  const double q2 = r.hi / b.hi;
  const DoubleDouble left = r - b * q2;
  return quick_two_sum(q1, q2) + left.hi / b.hi;
}

/// ln(x), with an absolute error of about 1e-31 max(1, |ln x|), and e^x, with a relative error of
/// about 1e-31 max(1, |x|), for x such that e^x is in range. Both are slow.
DoubleDouble log(DoubleDouble x);
DoubleDouble exp(DoubleDouble x);

/// x with its last `bits` bits set to 0.
constexpr double cut(double x, int bits) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & ~((1ull << bits) - 1));
}

// The functions below are faster. Their results are not renormalised: |lo| may reach 2^-16 |hi|.
// They accept such arguments; the operators above do not.

/// a b with a relative error below 2^-68: the product of the 26 upper bits of each is exact.
inline DoubleDouble quick_product(DoubleDouble a, DoubleDouble b) {
  const double a1 = cut(a.hi, 27), b1 = cut(b.hi, 27), a2 = (a.hi - a1) + a.lo;
  return {a1 * b1, a1 * ((b.hi - b1) + b.lo) + a2 * (b.hi + b.lo)};
}

/// ln(1 + r)/r for |r| <= 1/128: relative error below 2^-66.
DoubleDouble log1p_ratio(DoubleDouble r);

/// ln(x) for a normal number x with |lo| <= ulp(hi): absolute error below 2^-66 max(1, |ln x|).
DoubleDouble quick_log(DoubleDouble x);

/// f e^x: within 0.51 ulp; |x| below 1e5.
double times_exp(DoubleDouble f, DoubleDouble x);
/// 1 - e^x: relative error below 2^-55 for |x| > 1/32.
DoubleDouble one_minus_exp(DoubleDouble x);
/// (e^x - 1)/x for |x| <= 1/32: relative error below 2^-57.
DoubleDouble expm1_ratio(DoubleDouble x);

}  // namespace rolling
