// SPDX-License-Identifier: GPL-3.0-or-later
// The sum of two doubles and the error of its rounding, which is a double (Knuth; Dekker 1971).
#pragma once

#include <cfloat>

#if defined __FAST_MATH__ || defined __ASSOCIATIVE_MATH__ || __FINITE_MATH_ONLY__
#error "rolling rests on exact sums of doubles: build it without -ffast-math"
#endif
#if FLT_EVAL_METHOD != 0
#error "rolling rests on sums rounded to double: on x87 add -msse2 -mfpmath=sse"
#endif

namespace rolling {

/// hi + lo is a + b, exactly.
struct TwoSum {
  double hi, lo;
};

constexpr TwoSum two_sum(double a, double b) {
  const double sum = a + b;
  const double of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}

/// For |a| >= |b|.
constexpr TwoSum quick_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

}  // namespace rolling
