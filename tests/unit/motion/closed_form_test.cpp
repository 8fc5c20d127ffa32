// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/closed_form.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"
#include "unit/catch.h"
#include "unit/motion/closed_form_reference.h"
#include "unit/motion/random_scene.h"

using namespace rolling;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
const Body cylinder{1.375, 0.04, 0.5}, shell{1.375, 0.04, 0.83};

/// Largest errors in ulp.
struct Errors {
  double v = 0, x = 0, a = 0;
  void add(ClosedForm& motion, const ClosedFormReference& r) {
    v = std::max(v, ulp_error(motion.velocity(), r.v));
    x = std::max(x, ulp_error(motion.position(), r.x));
    a = std::max(a, ulp_error(motion.acceleration(), r.a));
  }
};

}  // namespace

TEST_CASE("ClosedForm: random scenes against 80 digits", "[rolling]") {
  std::mt19937_64 random(3);
  Errors worst;
  const int samples = 3000;  // tests/bench/ulp takes 1e5
  for (int n = 0; n < samples;) {
    const RandomScene scene = random_scene(random);
    ClosedForm motion(scene.body, scene.law, scene.v0, 0);
    for (int i = 0; i < 4; ++i) {
      const double t = random_time(random, scene, motion.stop_time(), i);
      const ClosedFormReference exact = closed_form_reference(scene.body, scene.law, scene.v0, t);
      if (exact.v < 1e-300) continue;  // denormal
      motion.seek(t);
      INFO("a " << scene.law.a << " b " << scene.law.b << " K " << scene.body.K << " R "
                << scene.body.R << " v0 " << scene.v0 << " t " << t);
      worst.add(motion, exact);
      ++n;
      REQUIRE((worst.v <= 0.6 && worst.x <= 1 && worst.a <= 0.6));
    }
  }
  CHECK(worst.v > 0.4);  // it was compared with something
}

TEST_CASE("ClosedForm: every kind of b and of v0, early, on the way and at t*(1 - 1e-9)",
          "[rolling]") {
  for (const double b : {-2.0, -0.5,        0.0,       1e-300,      1e-17, 1e-8,    0.0244,
                         0.5,  0.9,         1 - 1e-12, 1 - eps / 2, 1.0,   1 + eps, 1 + 1e-12,
                         1.5,  2 - 4 * eps, 2.0,       2 + 4 * eps, 2.5,   7.0})
    for (const double v0 : {1e-60, 1e-25, 1e-8, 0.5, 3.0, 1e20, 1e60}) {
      const double a = 1e-3 * std::pow(v0, -b);
      if (!(a > 1e-67 && a < 1e67)) continue;
      Errors worst;
      ClosedForm motion(cylinder, {a, b}, v0, 0);
      const double unit = v0 / (1e-3 * 9.81 / 0.06), stop = motion.stop_time();
      for (const double part : {1e-12, 1e-4, 0.01, 0.3, 0.7, 0.999, 1 - 1e-6, 1 - 1e-9}) {
        const double t = std::isinf(stop) ? 10 * unit * part : stop * part;
        const ClosedFormReference exact = closed_form_reference(cylinder, {a, b}, v0, t);
        if (exact.v < 1e-290 || exact.x < 1e-290 || exact.x > 1e300 ||
            exact.a < -0.04 * 9.81 / 0.06)
          continue;
        motion.seek(t);
        INFO("b " << b << " v0 " << v0 << " t/stop " << part << " v " << motion.velocity() << " x "
                  << motion.position() << " a " << motion.acceleration());
        worst.add(motion, exact);
        REQUIRE((worst.v <= 0.6 && worst.x <= 1 && worst.a <= 0.6));
      }
      if (std::isinf(stop) || stop > 1e300) continue;
      CHECK(closed_form_reference(cylinder, {a, b}, v0, stop).v == 0);  // t* is rounded up ...
      if (stop > 1e-290 && b < 0.95)
        CHECK(closed_form_reference(cylinder, {a, b}, v0, std::nextafter(stop, 0)).v >
              0);  // ... and no further
      motion.seek(stop);
      CHECK((motion.velocity() == 0 && motion.acceleration() == 0));
      if (motion.position() > 1e-290)
        CHECK(ulp_error(motion.position(), closed_form_reference(cylinder, {a, b}, v0, stop).x) <=
              1);
    }
}

TEST_CASE("ClosedForm: Eq. 13 as the paper prints it", "[rolling]") {
  for (const Body& body : {cylinder, shell})
    for (const double b : {-0.3, 0.0, 0.0244, 0.215, 0.6, 1.4, 2.0, 2.5})
      for (const double v0 : {0.02, 0.5, 3.0}) {
        const double a = 1.87e-3;
        ClosedForm motion(body, {a, b}, v0, 0.25);
        const long double ac = 1.0L * a * body.g / ((1.0L + body.K) * body.R), s = 1.0L - b;
        const double end = std::isinf(motion.stop_time()) ? 50 : 0.99 * motion.stop_time();
        if (b < 1)
          CHECK(
              std::abs(motion.stop_time() / static_cast<double>(std::pow(1.0L * v0, s) / (s * ac)) -
                       1) <= 4 * eps);
        for (int i = 1; i <= 20; ++i) {
          const double t = end * i / 20;
          motion.seek(t);
          const long double v = std::pow(std::pow(1.0L * v0, s) - s * ac * t, 1 / s);
          const long double x =
              b == 2 ? std::log(v0 / v) / ac
                     : (std::pow(1.0L * v0, 2.0L - b) - std::pow(v, 2.0L - b)) / (ac * (2.0L - b));
          INFO("K " << body.K << " b " << b << " v0 " << v0 << " t " << t);
          const double condition = 1 + t * static_cast<double>(ac * std::pow(v, b - 1.0L));
          CHECK(std::abs(motion.velocity() / static_cast<double>(v) - 1) <= 8 * eps * condition);
          CHECK(std::abs(motion.position() - 0.25 - static_cast<double>(x)) <=
                8 * eps * static_cast<double>(x) + eps);
          if (a * std::pow(motion.velocity(), b) > body.R) continue;
          CHECK(std::abs(motion.shift() / static_cast<double>(a * std::pow(v, 1.0L * b)) - 1) <=
                8 * eps * condition);
          CHECK(std::abs(motion.acceleration() / static_cast<double>(ac * std::pow(v, 1.0L * b)) +
                         1) <= 8 * eps * condition);
        }
      }
}

TEST_CASE("ClosedForm: b = 1 and its neighbours are the exponential", "[rolling]") {
  for (const double b : {1 - 1e-15, 1 - eps / 2, 1.0, 1 + eps, 1 + 1e-15}) {
    ClosedForm motion(cylinder, {1.87e-3, b}, 0.5, 0);
    const double rate = 1.87e-3 * 9.81 / (1.5 * 0.04);
    for (const double t : {1e-9, 0.1, 1.0, 10.0, 100.0}) {
      motion.seek(t);
      const double difference =
          std::abs(1 - b) * rate * t * (rate * t + 1);  // of first order in 1 - b
      CHECK(std::abs(motion.velocity() / (0.5 * std::exp(-rate * t)) - 1) <=
            difference + 16 * eps * (1 + rate * t));
      CHECK(std::abs(motion.position() / (-0.5 * std::expm1(-rate * t) / rate) - 1) <=
            difference + 8 * eps);
    }
    for (const double t : {1e130, 1e110, 1e90}) {  // at rest, as far as a double tells
      motion.seek(t);
      CHECK((motion.velocity() == 0 && motion.acceleration() == 0));
      CHECK(std::abs(motion.position() * rate / 0.5 - 1) <= 16 * eps);
    }
    CHECK((b < 1 ? motion.stop_time() > 1e14 : std::isinf(motion.stop_time())));
  }
}

TEST_CASE("ClosedForm: the paper's scenes stop later than the exact ones by what simulate(1) says",
          "[rolling]") {
  CHECK(std::abs(ClosedForm(cylinder, {1.87e-3, 0.215}, 0.5, 0).stop_time() / 2.41718911155359 -
                 1.00035) < 5e-6);
  CHECK(std::abs(ClosedForm(shell, {1.78e-3, 0.255}, 0.5, 0).stop_time() / 3.35660676251978 -
                 1.00023) < 5e-6);
  CHECK(std::abs(ClosedForm(shell, {5.75e-4, 0.0244}, 0.5, 0).stop_time() / 6.7638660251676 -
                 1.00005) < 5e-6);
}

TEST_CASE("ClosedForm: from the stop on it is at rest, to the last bit", "[rolling]") {
  ClosedForm motion(cylinder, {1.87e-3, 0.215}, 0.5, 1);
  const double T = motion.stop_time();
  motion.seek(std::nextafter(T, 0));
  CHECK(motion.velocity() > 0);
  const double x = motion.position();
  for (const double t : {T, std::nextafter(T, 10), 100.0}) {
    motion.seek(t);
    CHECK((motion.velocity() == 0 && motion.acceleration() == 0 && motion.shift() == 0));
    CHECK_FALSE(std::signbit(motion.acceleration()));
    CHECK(std::abs(motion.position() - x) <= eps);
  }
}

TEST_CASE("ClosedForm: at rest from the start", "[rolling]") {
  for (const double b : {-0.5, 0.0, 0.215, 1.0, 2.0}) {
    ClosedForm motion(cylinder, {1.87e-3, b}, 0, 0.7);
    CHECK(motion.stop_time() == 0);
    motion.seek(3);
    CHECK((motion.velocity() == 0 && motion.position() == 0.7 && motion.acceleration() == 0 &&
           motion.shift() == 0));
  }
}
