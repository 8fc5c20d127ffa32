// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/double_double.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "unit/catch.h"
#include "unit/motion/closed_form_reference.h"

using namespace rolling;

namespace {

Real real(DoubleDouble x) { return Real(x.hi) + x.lo; }

/// Largest relative error over random arguments.
template <typename Sample>
double worst(int samples, Sample&& sample) {
  std::mt19937_64 random(1);
  double worst = 0;
  for (int i = 0; i < samples; ++i) {
    const auto [value, exact, scale] = sample(
        [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); });
    worst = std::max(worst, static_cast<double>(abs(value - exact) / scale));
  }
  return worst;
}

struct Compared {
  Real value, exact, scale;
};

template <typename Uniform>
DoubleDouble any(Uniform&& between) {
  const double hi = std::ldexp(between(-2, 2), static_cast<int>(between(-40, 40)));
  return quick_two_sum(hi, hi * between(-0.5, 0.5) * 0x1p-53);
}

}  // namespace

TEST_CASE("DoubleDouble: sums and products of doubles are exact", "[base]") {
  CHECK(worst(2000, [](auto between) {
          const double a = any(between).hi, b = any(between).hi;
          return Compared{real(two_sum(a, b)), Real(a) + b, 1};
        }) == 0);
  CHECK(worst(2000, [](auto between) {
          const double a = any(between).hi, b = any(between).hi;
          return Compared{real(two_product(a, b)), Real(a) * b, 1};
        }) == 0);
}

TEST_CASE("DoubleDouble: arithmetic to about 2^-104", "[base]") {
  const auto sample = [](auto operation) {
    return [operation](auto between) {
      const DoubleDouble a = any(between), b = any(between);
      const Real exact = operation(real(a), real(b));
      return Compared{real(operation(a, b)), exact, abs(exact)};
    };
  };
  CHECK(worst(2000, sample([](auto a, auto b) { return decltype(a)(a + b); })) < 0x1p-103);
  CHECK(worst(2000, sample([](auto a, auto b) { return decltype(a)(a - b); })) < 0x1p-103);
  CHECK(worst(2000, sample([](auto a, auto b) { return decltype(a)(a * b); })) < 0x1p-101);
  CHECK(worst(2000, sample([](auto a, auto b) { return decltype(a)(a / b); })) < 0x1p-100);
}

TEST_CASE("DoubleDouble: the product with a double, and the quick one", "[base]") {
  CHECK(worst(2000, [](auto between) {
          const DoubleDouble f = any(between);
          const double x = any(between).hi;
          const Real exact = real(f) * x;
          return Compared{real(f * x), exact, abs(exact)};
        }) < 0x1p-102);
  CHECK(worst(2000, [](auto between) {
          const DoubleDouble f = any(between);
          DoubleDouble x = any(between);
          x.lo += x.hi * between(-1, 1) * 0x1p-16;
          const Real exact = real(f) * real(x);
          return Compared{real(quick_product(f, x)), exact, abs(exact)};
        }) < 0x1p-68);
}

TEST_CASE("DoubleDouble: the functions keep the errors that they state", "[base]") {
  CHECK(worst(100, [](auto between) {
          const DoubleDouble x(std::pow(10, between(-9, 9)), 0);
          const Real exact = log(real(x));
          return Compared{real(log(x)), exact, 1 + abs(exact)};
        }) < 1e-31);
  CHECK(worst(100, [](auto between) {
          const DoubleDouble x(between(-600, 600));
          const Real exact = exp(real(x));
          return Compared{real(exp(x)), exact, exact * Real(1 + abs(real(x)))};
        }) < 1e-31);
  CHECK(worst(3000, [](auto between) {
          const double hi = std::pow(10, between(-25, 3));
          const DoubleDouble x(hi, hi * between(-1, 1) * 0x1p-54);
          const Real exact = log(real(x));
          return Compared{real(quick_log(x)), exact, 1 + abs(exact)};
        }) < 0x1p-66);
  CHECK(worst(3000, [](auto between) {  // next to 1 it is the relative error that counts
          const DoubleDouble x(1 + (between(0, 1) < 0.5 ? -1 : 1) * between(0x1p-7, 0x1p-5));
          const Real exact = log(real(x));
          return Compared{real(quick_log(x)), exact, abs(exact)};
        }) < 0x1p-66);
  CHECK(worst(2000, [](auto between) {
          const DoubleDouble r(between(-1, 1) / 128, between(-1, 1) * 1e-19);
          const Real exact = log(1 + real(r)) / real(r);
          return Compared{real(log1p_ratio(r)), exact, exact};
        }) < 0x1p-65);
  CHECK(worst(2000, [](auto between) {
          const DoubleDouble x(between(-1, 1) / 32, between(-1, 1) * 1e-19);
          const Real exact = (exp(real(x)) - 1) / real(x);
          return Compared{real(expm1_ratio(x)), exact, exact};
        }) < 0x1p-57);
  CHECK(worst(2000, [](auto between) {
          const DoubleDouble x((between(0, 1) < 0.5 ? -1 : 1) * std::exp2(between(-5, 9)));
          const Real exact = 1 - exp(real(x));
          return Compared{real(one_minus_exp(x)), exact, abs(exact)};
        }) < 0x1p-55);
  CHECK(worst(2000, [](auto between) {
          const DoubleDouble x(between(-600, 600), between(-1, 1) * 1e-15);
          const double f = between(1, 100);
          const Real exact = Real(f) * exp(real(x));
          return Compared{Real(ulp_error(times_exp(f, x), exact)), 0, 1};
        }) < 0.51);
}
