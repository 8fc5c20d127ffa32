// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"
#include "unit/motion/closed_roll.h"
#include "motion/roll.h"
#include "motion/scene.h"
#include "unit/catch.h"
#include "unit/motion/exact_form_reference.h"
#include "unit/motion/random_scene.h"
#include "unit/many.h"
#include "unit/exact_body.h"

using namespace rolling;

namespace {

const Body cylinder{1.375, 0.04, 0.5}, shell{1.375, 0.04, 0.83};

std::unique_ptr<Motion> exact_roll(const Body& body, PowerLaw law, double v0, double x0 = 0) {
  return start({exact_body(body), law, {0}, v0, x0}, {Method::exact}, 0);
}

/// At T(1 - 1e-3), T(1 - 1e-6), T(1 - 1e-9) and at a random time.
void check(const RandomScene& scene, std::mt19937_64& random) {
  const ExactFormReference reference(scene.body, scene.law, scene.v0);
  const auto motion = exact_roll(scene.body, scene.law, scene.v0);
  const double unit =
      scene.v0 / (scene.law(scene.v0) * scene.body.g / ((scene.body.K + 1) * scene.body.R));
  for (int i = 0; i < 4; ++i) {
    const double T = motion->stop_time(), t = i < 3 && std::isfinite(T)
                                                  ? T * (1 - std::pow(1e-3, i + 1))
                                                  : random_time(random, scene, T, i);
    motion->seek(t);
    if (motion->velocity() < 1e-300) continue;  // denormal
    const auto error = reference.errors(t, motion->velocity(), motion->position());
    const double way = std::max(motion->position(), scene.v0 * unit);
    INFO("a " << scene.law.a << " b " << scene.law.b << " K " << scene.body.K << " R "
              << scene.body.R << " v0 " << scene.v0 << " t " << t << " 1 - D/R "
              << 1 - scene.law(scene.v0) / scene.body.R << " t/T " << t / T << " v " << error.v
              << " x " << error.x);
    // A rounding of D makes as much of A as that is small, and all of the force where K = 0.
    const double D = scene.law(scene.v0), A = std::sqrt(1 - D / scene.body.R),
                 of_D = 1e-16 / std::max(A * (A + scene.body.K), 1e-8);
    REQUIRE(std::abs(error.v) * motion->velocity() <= (1e-13 + of_D) * scene.v0);
    REQUIRE(std::abs(error.x) * motion->position() <= (1e-13 + of_D) * way);
  }
}

}  // namespace

TEST_CASE("Exact geometry: random scenes against 60 digits, until just before the stop",
          "[rolling]") {
  std::mt19937_64 random(4);
  for (unsigned n = 0; n < of_many(2000); ++n)
    check(random_scene(random), random);  // tests/bench/ulp takes more
}

TEST_CASE("Exact geometry: D(v0) near R, against 60 digits", "[rolling]") {
  std::mt19937_64 random(5);
  for (int n = 0; n < 60; ++n) check(deep_scene(random, n), random);
}

TEST_CASE("Exact geometry: b < 0, where the roll ends as D reaches R", "[rolling]") {
  std::mt19937_64 random(6);
  const auto between = [&](double lo, double hi) {
    return std::uniform_real_distribution(lo, hi)(random);
  };
  int stops = 0;
  for (int n = 0; n < 40; ++n) {
    RandomScene scene = random_scene(random);
    scene.law.b = -std::pow(10, between(-2, 0.5));
    deepen(scene, std::pow(10, between(-4, -0.1)));
    const ExactFormReference reference(scene.body, scene.law, scene.v0);
    const auto motion = exact_roll(scene.body, scene.law, scene.v0);
    const double unit =
        scene.v0 / (scene.law(scene.v0) * scene.body.g / ((scene.body.K + 1) * scene.body.R));
    const double end =
        std::min(motion->stop_time(),
                 Roll(exact_body(scene.body), scene.law, scene.v0).radius_time(1e9 * unit));
    for (const double part : {0.1, 0.9, 1 - 1e-6, 1 - 1e-9}) {
      motion->seek(part * end);
      const auto error = reference.errors(part * end, motion->velocity(), motion->position());
      INFO("a " << scene.law.a << " b " << scene.law.b << " K " << scene.body.K << " R "
                << scene.body.R << " v0 " << scene.v0 << " t/end " << part << " v " << error.v
                << " x " << error.x << " by t " << error.v_by_t);
      // As good as t is as a double.
      CHECK(std::abs(error.v) * motion->velocity() <=
            1e-13 * scene.v0 +
                4 * std::numeric_limits<double>::epsilon() * error.v_by_t * motion->velocity());
      CHECK(std::abs(error.x) <= 1e-13);
    }
    if (std::isinf(motion->stop_time())) CHECK_THROWS_AS(motion->seek(end * (1 + 1e-9)), Error);
    stops += std::isfinite(motion->stop_time());
  }
  CHECK((stops > 0 && stops < 20));  // b so near 0 that nobody sees D reach R, and others
}

TEST_CASE("Exact geometry: the stopping times of the paper's scenes", "[rolling]") {
  CHECK(std::abs(exact_roll(cylinder, {1.87e-3, 0.215}, 0.5)->stop_time() - 2.41718911155359) <
        5e-15 * 2.4);
  CHECK(std::abs(exact_roll(shell, {1.78e-3, 0.255}, 0.5)->stop_time() - 3.35660676251978) <
        5e-15 * 3.4);
  CHECK(std::abs(exact_roll(shell, {5.75e-4, 0.0244}, 0.5)->stop_time() - 6.7638660251676) <
        2e-14 * 6.8);
}

TEST_CASE("Exact geometry: x' = v and v' = -g D / ((K + A) R) along the way", "[rolling]") {
  for (const double b : {0.0, 0.215, 0.8, 1.0, 1.7})
    for (const double a : {1.87e-3, 0.02, 0.039}) {
      const auto motion = exact_roll(cylinder, {a, b}, 1, 0.1);
      const double end = std::isinf(motion->stop_time()) ? 2 : motion->stop_time();
      for (int i = 1; i < 20; ++i) {
        const double t = end * i / 20.0, h = 1e-4 * end * (1 - i / 20.0);
        const auto at = [&](double time) {
          motion->seek(time);
          return std::pair(motion->position(), motion->velocity());
        };
        // fourth order central difference
        const auto [x1, v1] = at(t - 2 * h);
        const auto [x2, v2] = at(t - h);
        const auto [x3, v3] = at(t + h);
        const auto [x4, v4] = at(t + 2 * h);
        motion->seek(t);
        const double D = a * std::pow(motion->velocity(), b), A = std::sqrt(1 - D * D / 0.0016);
        INFO("a " << a << " b " << b << " i " << i);
        CHECK(std::abs((x1 - 8 * x2 + 8 * x3 - x4) / (12 * h) - motion->velocity()) < 1e-10);
        CHECK(std::abs((v1 - 8 * v2 + 8 * v3 - v4) / (12 * h) - motion->acceleration()) < 1e-9);
        CHECK(std::abs(motion->acceleration() + 9.81 * D / ((0.5 + A) * 0.04)) < 1e-12);
        CHECK(motion->shift() == D);
      }
    }
}

TEST_CASE("Exact geometry: a shallow shift is the closed form, with a difference of second order",
          "[rolling]") {
  double before = 0;
  for (const double a : {8e-3, 4e-3, 2e-3, 1e-3}) {
    const auto exact = exact_roll(cylinder, {a, 0.215}, 0.5);
    const auto closed_owned = closed_roll(cylinder, {a, 0.215}, 0.5, 0);
    Motion& closed = *closed_owned;
    exact->seek(0.2 / a * 1e-3);
    closed.seek(0.2 / a * 1e-3);
    const double difference = closed.velocity() - exact->velocity();
    CHECK(difference > 0);
    if (before > 0) CHECK(std::abs(before / difference - 4) < 0.1);
    before = difference;
  }
}

TEST_CASE("Exact geometry: rest, and refusals", "[rolling]") {
  const auto motion = exact_roll(cylinder, {0.03, 0.215}, 1, 2);
  motion->seek(motion->stop_time());
  CHECK((motion->velocity() == 0 && motion->acceleration() == 0 && motion->shift() == 0));
  CHECK_THROWS_AS(exact_roll(cylinder, {0.05, 0.215}, 1), Error);
  const auto grows = exact_roll(cylinder, {2e-3, -0.5}, 0.5);
  CHECK(std::isinf(grows->stop_time()));
  CHECK_THROWS_AS(grows->seek(10), Error);
}
