// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/road_roll.h"

#include "base/error.h"
#include "contact/road.h"
#include "motion/roll.h"
#include "unit/catch.h"
#include "unit/exact_body.h"

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

using namespace rolling;

namespace {

const Road* road(double from, double to, double step, const std::function<double(double)>& height) {
  std::vector<double> x;
  std::vector<double> h;
  for (double place = from; place < to + step / 2; place += step) {
    x.push_back(place);
    h.push_back(height(place));
  }
  static std::vector<std::unique_ptr<const Road>> all;
  all.push_back(std::make_unique<const Road>(x, h));
  return all.back().get();
}

double hills(double x) { return std::sin(2 * std::numbers::pi * x / 800); }
double bowl(double x) { return 0.57 * (1 - std::cos(x / 0.57)); }

/// A road, a body on it, and a law.
struct Case {
  Body body;
  Law law;
  double v0, x0;
  std::vector<double> times;
};

const double drag[]{3.058103975535168e-3, 8.154943934760448e-6};
const double constant[]{2.54e-5};

std::vector<Case> cases() {
  const Body car{.m = 1, .R = 0.3, .K = 0.04, .wind = 2, .road = road(-60, 2600, 5, hills)};
  const Body ball{.m = 1, .R = 0.0127, .K = 0.4, .road = road(-0.3, 0.3, 2e-3, bowl)};
  const Body cylinder{.m = 1, .R = 0.04, .K = 0.5, .road = road(-0.3, 0.3, 2e-3, bowl)};
  return {{car, Law(laws()[4], drag), 33, 1, {0, 10, 50, 100}},
          {ball, Law(laws()[1], constant), 0, 0.15, {0.1, 0.9, 2, 8.95}},
          {exact_body(ball), PowerLaw{5e-5, 0.2}, 0.1, -0.14, {0.05, 1.5, 4}},
          {exact_body(cylinder), PowerLaw{1.87e-3, 0.215}, 0.5, 0.01, {0.1, 0.3, 0.6, 1.2}}};
}

}  // namespace

TEST_CASE("road: the spline through a parabola is the parabola", "[road]") {
  const Road parabola({-1, 0.5, 0.75, 2}, {0.1, 0.025, 0.05625, 0.4});
  for (const double x : {-1.0, -0.2, 0.6, 1.9}) {
    const Road::Place at = parabola.at(x);
    CHECK(at.h == Approx(0.1 * x * x));
    CHECK(at.h1 == Approx(0.2 * x));
    CHECK(at.h2 == Approx(0.2));
    CHECK(at.h3 == Approx(0).margin(1e-12));
    CHECK(parabola.mirrored()->at(-x).h1 == Approx(-0.2 * x));
  }
  CHECK_THROWS_AS(Road({0, 0}, {0, 0}), Error);
  CHECK_THROWS_AS(Road({0, 1}, {0, 1.5}), Error);
  CHECK_THROWS_AS(Road({0}, {0}), Error);
}

// The turn is where a derivative that is taken at fixed times jumps.
TEST_CASE("road: the derivatives of a roll are limits of differences", "[road]") {
  for (const Case& one : cases()) {
    const std::size_t size = one.law.size();
    for (const double t : one.times)
      for (std::size_t number = 0; number < size + 5; ++number) {
        const auto at = [&](double by) {
          std::array<double, 3> c{};
          for (std::size_t j = 0; j < size; ++j) c[j] = one.law.c(j);
          Case moved = one;
          double* const values[]{&moved.v0, &moved.x0, &moved.body.slope, &moved.body.wind,
                                 &moved.body.steepness};
          double& value = number < size ? c[number] : *values[number - size];
          value += by;
          const Law law(one.law.form(), c);
          RoadRoll roll(moved.body, law, moved.v0, moved.x0);
          Roll::Point p = roll.at(t);
          p.x += moved.x0;
          return p;
        };
        // From rest it rolls towards falling x, where v0 = 0 is a kink.
        const bool of_rest = one.v0 == 0 && number == size;
        double h = number == size + 2 || of_rest ? 1e-5 : 1e-4;
        if (number < size) h *= one.law.c(number);
        const Roll::Point p = at(0);
        const Roll::Point more = at(of_rest ? 0 : h);
        const Roll::Point less = at(-h);
        const double width = of_rest ? h : 2 * h;
        const std::size_t place[]{0, 0, size, size + 1, size + 2};
        double v_p = 0;
        double x_p = 0;
        if (number < size) v_p = p.v_c[number], x_p = p.x_c[number];
        else if (number == size) v_p = p.v_v0, x_p = p.x_v0;
        else if (number == size + 1) v_p = p.v_x0, x_p = p.x_x0;
        else v_p = p.v_c[place[number - size]], x_p = p.x_c[place[number - size]];
        CAPTURE(one.v0, t, number);
        const double loose = of_rest ? 1e-4 : 2e-6;
        CHECK(v_p == Approx((more.v - less.v) / width).epsilon(loose).margin(loose));
        CHECK(x_p == Approx((more.x - less.x) / width).epsilon(loose).margin(loose));
      }
  }
}

// A line of heights is a slope, up, at the turn and back; so are its derivatives.
TEST_CASE("road: a straight road is a slope", "[road]") {
  for (const bool is_exact : {false, true})
    for (const double slope : {0.02, -1e-4, 0.1}) {
      Body body{.m = 1, .R = 0.0127, .K = 0.4, .slope = slope};
      Roll right(exact_body(body, is_exact), PowerLaw{5e-5, 0.1}, 0.5);
      body.slope = 0;
      const double sine = slope / std::hypot(1, slope);
      body.road = road(-20, 20, 0.37, [=](double x) { return sine * x; });
      Roll roll(exact_body(body, is_exact), PowerLaw{5e-5, 0.1}, 0.5, 0.3);
      for (const double t : {0.0, 0.3, 1.0, 3.0, 5.0, 7.0}) {
        CAPTURE(slope, t);
        const Roll::Point p = roll.at(t);
        const Roll::Point q = right.at(t);
        CHECK(p.x == Approx(q.x).epsilon(1e-10).margin(1e-10));
        CHECK(p.v == Approx(q.v).epsilon(1e-10).margin(1e-10));
        CHECK(p.a == Approx(q.a).epsilon(1e-9));
        CHECK(p.x_v0 == Approx(q.x_v0).epsilon(1e-8));
        CHECK(p.v_v0 == Approx(q.v_v0).epsilon(1e-8));
        for (const std::size_t j : {0u, 1u}) {
          CHECK(p.x_c[j] == Approx(q.x_c[j]).epsilon(1e-7).margin(1e-8));
          CHECK(p.v_c[j] == Approx(q.v_c[j]).epsilon(1e-7).margin(1e-8));
        }
      }
      if (slope > 0) CHECK(roll.stop_time() == Approx(right.stop_time()).epsilon(1e-11));
      if (slope > 0) CHECK(roll.turns() == right.turns());
    }
}

// Of every conservative part: on a road without a loss E is that of the height.
TEST_CASE("road: without a loss the energy stays", "[road]") {
  const double none[]{0};
  Body ball{.m = 1, .R = 0.0127, .K = 0.4, .road = road(-0.3, 0.3, 2e-3, bowl), .steepness = 1.1};
  RoadRoll roll(ball, Law(laws()[1], none), 0, 0.2);
  for (double t = 0; t < 20; t += 0.37) {
    const Roll::Point p = roll.at(t);
    const double fall = 1.1 * (ball.road->at(0.2).h - ball.road->at(0.2 + p.x).h);
    CHECK(0.7 * p.v * p.v == Approx(9.81 * fall).epsilon(1e-9).margin(1e-10));
  }
}

// A segment must not be longer than the dv/dt with which it was planned: h'' changes by much from
// point to point.
TEST_CASE("road: a body swings in rough bowls", "[road]") {
  std::mt19937 random(1);
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution(from, to)(random);
  };
  for (int i = 0; i < 300; ++i) {
    std::vector<double> x;
    std::vector<double> h;
    for (double place = -0.3; place < 0.3; place += 0.02 * uniform(0.3, 1.7)) {
      x.push_back(place);
      h.push_back(place * place / 1.14 + 5e-4 * std::normal_distribution()(random));
    }
    const Road rough(x, h);
    const Body ball{.m = 1, .R = 0.0127, .K = 0.4, .road = &rough};
    const double x0 = uniform(-0.1, 0.1);
    RoadRoll roll(ball, PowerLaw{5e-5, 0.2}, 0.1, x0);
    CAPTURE(i);
    double before = INFINITY;
    for (const double t : {0.0, 2.0, 4.0}) {
      const Roll::Point p = roll.at(t);
      const double energy = 0.7 * p.v * p.v + 9.81 * rough.at(x0 + p.x).h;
      CHECK(energy < before);
      before = energy;
    }
    CHECK(roll.evaluations() < 50'000);
  }
}

TEST_CASE("road: a body leaves the table or the track, begins outside, or is held", "[road]") {
  const Law law(laws()[1], constant);
  Body ball{.m = 1, .R = 0.0127, .K = 0.4, .road = road(-0.3, 0.3, 2e-3, bowl)};
  CHECK_THROWS_AS(RoadRoll(ball, law, 0, 0.31), Error);
  RoadRoll out(ball, law, 2, 0);
  CHECK(out.at(0.1).v > 0);
  CHECK_THROWS_AS(out.at(1), Error);
  RoadRoll held(ball, law, 0, 1e-4);
  CHECK((held.at(5).v == 0 && held.at(5).x == 0 && held.stop_time() == 0 && !held.turns()));
  ball.road = road(-0.3, 0.3, 2e-3, [](double x) { return -bowl(x); });
  RoadRoll flies(ball, law, 2.4, 0);
  CHECK_THROWS_WITH(flies.at(0.1), Catch::Matchers::StartsWith("the body leaves the track"));
}
