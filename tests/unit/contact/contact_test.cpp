#include "contact/contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "base/error.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
const Body cylinder{1.375, 0.04, 0.5};

struct Scene {
  Body body;
  double D;
};

/// Bodies of all shapes and sizes, D anywhere within the radius.
Scene random_scene(std::mt19937_64& random) {
  const auto between = [&](double lo, double hi) {
    return std::uniform_real_distribution(lo, hi)(random);
  };
  const Body body{between(0.01, 5), between(1e-3, 2), between(0, 1), between(1, 25)};
  return {body, body.R * between(-1, 1)};
}

bool close(double x, double y, double scale) { return std::abs(x - y) <= 8 * eps * scale; }

}  // namespace

TEST_CASE("contact: forces and torques balance (Eqs. 3 to 10)", "[rolling]") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 2000; ++i) {
    const auto [c, D] = random_scene(random);
    for (const Geometry geometry : {Geometry::approximate, Geometry::exact}) {
      const double A = arm_factor(c, geometry, D), F_H = horizontal_force(c, geometry, D),
                   a = acceleration_from_shift(c, geometry, D);
      const double tau_H = torque_of_horizontal_force(c, geometry, D),
                   tau_N = torque_of_normal_force(c, D);
      const double F = std::abs(F_H), tau = std::abs(tau_H) + std::abs(tau_N);
      REQUIRE(close(c.m * a, F_H, F));                      // Eq. 4
      REQUIRE(close(tau_N + tau_H, c.K * c.R * F_H, tau));  // Eqs. 5, 3
      REQUIRE(close(tau_N, -c.m * c.g * D, tau));           // Eq. 7
      REQUIRE(close(tau_N * A, -(c.K + A) * tau_H, tau));   // Eq. 10
      if (geometry == Geometry::exact)
        REQUIRE(std::abs(std::hypot(A, D / c.R) - 1) <= 4 * eps);  // Eq. 8
      else REQUIRE(A == 1);
      REQUIRE(std::signbit(a) != std::signbit(D));
      REQUIRE(acceleration_from_shift(c, geometry, -D) == -a);
    }
  }
}

TEST_CASE("contact: D -> a -> D, both geometries", "[rolling]") {
  std::mt19937_64 random(2);
  for (int i = 0; i < 2000; ++i) {
    const auto [c, D] = random_scene(random);
    CHECK(close(shift_from_acceleration(c, Geometry::approximate,
                                        acceleration_from_shift(c, Geometry::approximate, D)),
                D, std::abs(D)));
    CHECK(close(
        shift_from_acceleration(c, Geometry::exact, acceleration_from_shift(c, Geometry::exact, D)),
        D, std::abs(D)));
  }
}

TEST_CASE("contact: the exact shift solves Eq. 9", "[rolling]") {
  // Bisection of s = d / (K + sqrt(1 - d^2)), which rises with d.
  for (const double K : {0.0, 0.4, 0.5, 0.83, 1.0, 1.3})
    for (const double s : {1e-12, 1e-3, 0.1, 0.5, 0.7, 0.99, 1.5, 40.0}) {
      if (s * K > 1) continue;
      double lo = 0, hi = 1;
      for (int i = 0; i < 120; ++i) {
        const double d = lo + (hi - lo) / 2;
        (d / (K + std::sqrt((1 - d) * (1 + d))) < s ? lo : hi) = d;
      }
      const Body c{1, 0.1, K, 10};
      CHECK(std::abs(shift_from_acceleration(c, Geometry::exact, -10 * s) - 0.1 * lo) <=
            4 * eps * 0.1 * lo);
    }
}

TEST_CASE("contact: the exact shift at its limits", "[rolling]") {
  CHECK(shift_from_acceleration({1, 0.1, 0.5, 10}, Geometry::exact, -20) == 0.1);  // |a| = g/K
  CHECK(shift_from_acceleration({1, 0.1, 0.5, 10}, Geometry::exact, 20) == -0.1);
  CHECK(std::abs(shift_from_acceleration({1, 0.1, 0, 10}, Geometry::exact, -1e300) - 0.1) <= 1e-16);
  for (const Geometry geometry : {Geometry::approximate, Geometry::exact}) {
    CHECK(shift_from_acceleration(cylinder, geometry, 0.0) == 0);
    CHECK_FALSE(std::signbit(shift_from_acceleration(cylinder, geometry, 0.0)));
    CHECK_FALSE(std::signbit(acceleration_from_shift(cylinder, geometry, 0.0)));
    CHECK(shift_from_acceleration(cylinder, geometry, 0.1) < 0);  // speeding up
  }
}

TEST_CASE("contact: a shift beyond the radius is refused", "[rolling]") {
  for (const Geometry geometry : {Geometry::approximate, Geometry::exact}) {
    CHECK_NOTHROW(acceleration_from_shift(cylinder, geometry, -0.04));
    CHECK_THROWS_AS(acceleration_from_shift(cylinder, geometry, 0.0400001), Error);
    CHECK_THROWS_AS(acceleration_from_shift(cylinder, geometry, std::nan("")), Error);
    // 3 g: in the exact geometry the formula alone would give 0.0348 m, with A < 0.
    CHECK_THROWS_AS(shift_from_acceleration(cylinder, geometry, -3 * 9.81), Error);
    CHECK_THROWS_AS(shift_from_acceleration(cylinder, geometry, 3 * 9.81), Error);
    CHECK_THROWS_AS(shift_from_acceleration(cylinder, geometry, std::nan("")), Error);
  }
  try {
    acceleration_from_shift(cylinder, Geometry::exact, 0.05);
  } catch (const Error& error) {
    CHECK(std::string(error.what()) == "the shift D = 0.05 m is beyond the radius 0.04 m");
  }
}
