// SPDX-License-Identifier: GPL-3.0-or-later
// The motion of Eq. 13 against 80 digits: what is off is no more than a rounding of the time would
// be, whatever b is.
#include <cmath>
#include <limits>
#include <random>

#include "unit/catch.h"
#include "unit/motion/closed_form_reference.h"
#include "unit/motion/closed_roll.h"
#include "unit/motion/random_scene.h"

using namespace rolling;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
const Body cylinder{1.375, 0.04, 0.5};

void compare(Motion& motion, const Body& body, PowerLaw law, double v0, double t) {
  const ClosedFormReference exact = closed_form_reference(body, law, v0, t);
  if (exact.v < 1e-300 || exact.x < 1e-290 || exact.x > 1e300) return;  // denormal, or beyond
  const auto error = [](double have, const Real& want, const Real& unit) {
    return static_cast<double>(abs(Real(have) - want) / unit);
  };
  motion.seek(t);
  INFO("a " << law.a << " b " << law.b << " v0 " << v0 << " t " << t);
  REQUIRE(error(motion.velocity(), exact.v, exact.v - exact.a * t) <= 8 * eps);
  REQUIRE(error(motion.position(), exact.x, exact.x) <= 8 * eps);
}

}  // namespace

TEST_CASE("closed form: random scenes against 80 digits", "[rolling]") {
  std::mt19937_64 random(3);
  for (int n = 0; n < 750; ++n) {
    const RandomScene scene = random_scene(random);
    const auto motion = closed_roll(scene.body, scene.law, scene.v0);
    for (int i = 0; i < 4; ++i)
      compare(*motion, scene.body, scene.law, scene.v0,
              random_time(random, scene, motion->stop_time(), i));
  }
}

TEST_CASE("closed form: every kind of b and of v0, early, on the way and at t*(1 - 1e-9)",
          "[rolling]") {
  for (const double b : {-2.0, -0.5,        0.0,       1e-300,      1e-17, 1e-8,    0.0244,
                         0.5,  0.9,         1 - 1e-12, 1 - eps / 2, 1.0,   1 + eps, 1 + 1e-12,
                         1.5,  2 - 4 * eps, 2.0,       2 + 4 * eps, 2.5,   7.0})
    for (const double v0 : {1e-60, 1e-25, 1e-8, 0.5, 3.0, 1e20, 1e60}) {
      const double a = 1e-3 * std::pow(v0, -b);
      if (!(a > 1e-67 && a < 1e67)) continue;
      const auto motion = closed_roll(cylinder, {a, b}, v0);
      const double stop = motion->stop_time(), unit = v0 / (1e-3 * 9.81 / 0.06);
      for (const double part : {1e-12, 1e-4, 0.01, 0.3, 0.7, 0.999, 1 - 1e-6, 1 - 1e-9})
        compare(*motion, cylinder, {a, b}, v0, std::isinf(stop) ? 10 * unit * part : stop * part);
    }
}

TEST_CASE("closed form: from the stop on it is at rest", "[rolling]") {
  const auto motion = closed_roll(cylinder, {1.87e-3, 0.215}, 0.5, 1);
  const double stop = motion->stop_time(), before = std::nextafter(stop, 0);
  motion->seek(before);
  const double x = motion->position();
  for (const double t : {stop, std::nextafter(stop, 10), 100.0}) {
    motion->seek(t);
    CHECK((motion->velocity() == 0 && motion->acceleration() == 0 && motion->shift() == 0));
    CHECK_FALSE(std::signbit(motion->acceleration()));
    CHECK(std::abs(motion->position() - x) <= eps);
  }
}
