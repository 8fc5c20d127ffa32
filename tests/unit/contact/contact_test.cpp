// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "base/error.h"
#include "unit/catch.h"
#include "unit/exact_body.h"

using namespace rolling;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
const Body cylinder{1.375, 0.04, 0.5};

struct Scene {
  Body body;
  double D;
};

/// Bodies of all shapes and sizes, D anywhere within the radius, on a level mat and on slopes.
Scene random_scene(std::mt19937_64& random) {
  const auto between = [&](double lo, double hi) {
    return std::uniform_real_distribution(lo, hi)(random);
  };
  const double slope = random() % 3 == 0 ? 0 : std::pow(10, between(-6, -0.3)) * between(-1, 1);
  const Body body{between(0.01, 5), between(1e-3, 2), between(0, 1), between(1, 25), slope};
  const double from_R = random() % 3 == 0 ? std::pow(10, between(-16, 0)) : between(0, 1);
  return {body, std::copysign(body.R - body.R * from_R, between(-1, 1))};
}

/// Eq. 8 in long double.
long double arm(const Body& c, long double D) {
  return c.exact ? std::sqrt((c.R - D) * (c.R + D)) / c.R : 1;
}

/// Eq. 12 in long double, from angles.
long double acceleration(const Body& c, long double D) {
  const long double theta = std::atan(static_cast<long double>(c.slope)), d = D / c.R,
                    A = arm(c, D);
  return -c.g * (d * std::cos(theta) + A * std::sin(theta)) / (c.K + A);
}

}  // namespace

TEST_CASE("contact: the acceleration is Eq. 12, on slopes too", "[contact]") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 4000; ++i) {
    auto [c, D] = random_scene(random);
    for (const bool is_exact : {false, true}) {
      c.exact = is_exact;
      const double a = acceleration_from_shift(c, D), A = arm_factor(c, D);
      const double scale = c.g * (std::abs(D) / c.R + std::abs(c.slope)) / (c.K + A);
      REQUIRE(std::abs(a - static_cast<double>(acceleration(c, D))) <= 8 * eps * scale);
      if (A > 0.01)  // near R a trial step need not be exact
        REQUIRE(std::abs(accelerate(c, D).a - a) <= 1e-12 * std::abs(a) + 1e-14);
      if (is_exact) REQUIRE(std::abs(A - arm(c, D)) <= 4 * eps * A);
      else REQUIRE(A == 1);
      if (c.slope == 0) {
        REQUIRE(std::signbit(a) != std::signbit(D));
        REQUIRE(acceleration_from_shift(c, -D) == -a);
      }
    }
  }
}

TEST_CASE("contact: the derivative that a solver takes is that of Eq. 12", "[contact]") {
  std::mt19937_64 random(5);
  for (int i = 0; i < 1000; ++i) {
    auto [c, D] = random_scene(random);
    D *= 0.9;  // the exact one has no end at |D| = R
    for (const bool is_exact : {false, true}) {
      c.exact = is_exact;
      const long double h = 1e-6L * c.R;
      const auto slope =
          static_cast<double>((acceleration(c, D + h) - acceleration(c, D - h)) / (2 * h));
      REQUIRE(std::abs(accelerate(c, D).by_D - slope) <= 1e-8 * (std::abs(slope) + c.g / c.R));
    }
  }
}

TEST_CASE("contact: D -> a -> D, both geometries, on slopes too", "[contact]") {
  std::mt19937_64 random(2);
  for (int i = 0; i < 4000; ++i) {
    auto [c, D] = random_scene(random);
    for (const bool is_exact : {false, true}) {
      c.exact = is_exact;
      const double back = shift_from_acceleration(c, acceleration_from_shift(c, D));
      CAPTURE(c.K, c.slope, D / c.R);
      // On a slope the acceleration tells D cos theta + A R sin theta, rounded.
      REQUIRE(std::abs(back - D) <= 16 * eps * (std::abs(D) + c.R * std::abs(c.slope)));
    }
  }
}

TEST_CASE("contact: the exact shift solves Eq. 12", "[contact]") {
  // Bisection in long double: the acceleration falls with D as long as K |slope| < 1.
  std::mt19937_64 random(3);
  for (int i = 0; i < 1000; ++i) {
    const Body c = random_scene(random).body;
    const double a =
        c.g * std::uniform_real_distribution(-1.0, 1.0)(random) / std::max(c.K, 1e-3) * 0.8;
    long double lo = -c.R, hi = c.R;
    if (acceleration(exact_body(c), lo) < a || acceleration(exact_body(c), hi) > a) continue;
    for (int k = 0; k < 100; ++k) {
      const long double D = lo + (hi - lo) / 2;
      (acceleration(exact_body(c), D) > a ? lo : hi) = D;
    }
    CAPTURE(c.K, c.slope, a / c.g, static_cast<double>(lo) / c.R);
    REQUIRE(std::abs(shift_from_acceleration(exact_body(c), a) - static_cast<double>(lo)) <=
            1e-14 * (std::abs(static_cast<double>(lo)) + c.R * std::abs(c.slope)));
  }
}

TEST_CASE("contact: the exact shift at its limits", "[contact]") {
  for (const double K : {0.1, 0.4, 0.5, 0.83, 1.0})
    for (const double slope : {0.0, 0.001, -0.3}) {
      const Body c{1, 0.1, K, 9.81, slope};
      for (const double D : {0.1, -0.1})
        CHECK(std::abs(shift_from_acceleration(exact_body(c),
                                               acceleration_from_shift(exact_body(c), D)) -
                       D) <= 2 * eps * 0.1);
    }
  CHECK(shift_from_acceleration(exact_body({1, 0.1, 0.5, 10}), -20) == 0.1);  // |a| = g/K
  CHECK(std::abs(shift_from_acceleration(exact_body({1, 0.1, 0, 10}), -1e300) - 0.1) <= 1e-16);
  for (const bool is_exact : {false, true}) {
    CHECK(shift_from_acceleration(exact_body(cylinder, is_exact), 0.0) == 0);
    CHECK_FALSE(std::signbit(shift_from_acceleration(exact_body(cylinder, is_exact), 0.0)));
    CHECK_FALSE(std::signbit(acceleration_from_shift(exact_body(cylinder, is_exact), 0.0)));
    CHECK(shift_from_acceleration(exact_body(cylinder, is_exact), 0.1) < 0);  // speeding up
  }
}

TEST_CASE("contact: a shift beyond the radius is refused where it has no meaning", "[contact]") {
  for (const bool is_exact : {false, true}) {
    CHECK_NOTHROW(acceleration_from_shift(exact_body(cylinder, is_exact), -0.04));
    CHECK_THROWS_AS(acceleration_from_shift(exact_body(cylinder, is_exact), 0.0400001), Error);
    CHECK_THROWS_AS(acceleration_from_shift(exact_body(cylinder, is_exact), std::nan("")), Error);
  }
  // 3 g: in the exact geometry the formula alone would give 0.0348 m, with A < 0.
  for (const double a : {-3 * 9.81, 3 * 9.81, std::nan("")})
    CHECK_THROWS_AS(shift_from_acceleration(exact_body(cylinder), a), Error);
  // Eq. 11 is a line, and noise in the acceleration may lead anywhere.
  CHECK(std::abs(shift_from_acceleration(cylinder, -3 * 9.81) - 0.18) < 1e-15);
  try {
    acceleration_from_shift(exact_body(cylinder), 0.05);
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(std::string(error.what()) == "the shift D = 0.05 m is beyond the radius 0.04 m");
  }
}
