#include "motion/law_roll.h"

#include "base/error.h"
#include "motion/trajectory.h"
#include "unit/catch.h"

#include <cmath>
#include <limits>
#include <vector>

using namespace rolling;

namespace {

const Body unit{1, 1, 0, 1};  // with A = 1, g/((K + 1) R) = 1: D is the deceleration

LawRoll roll(std::size_t law, const double* c, double v0 = 1) {
  return {unit, Geometry::approximate, {&laws()[law], 1, 1}, c, v0};
}

}  // namespace

TEST_CASE("law roll: for a v^b it is the trajectory, derivatives too", "[law]") {
  Body body{1.375, 0.04, 0.5};
  for (const Geometry geometry : {Geometry::approximate, Geometry::exact})
    for (const double slope : {0.0, 2e-3, -1e-3})
      for (const double b : {0.0244, 0.215, 0.6}) {
        body.slope = slope;
        const double c[]{5e-3, b};
        const Trajectory exact(body, geometry, {c[0], c[1]}, 0.5,
                               Trajectory::Derivatives::of_law_and_slope);
        LawRoll rolled(body, geometry, {&laws()[0], 1, 1}, c, 0.5);
        const double last = std::min(exact.stop_time(), 3.0);
        for (int i = 0; i <= 40; ++i) {
          const double t = 0.9999 * last * i / 40;
          const auto p = rolled.at(t);
          const auto q = exact.at(t);
          CAPTURE(slope, b, t, last);
          const auto same = [](double x, double y, double scale) {
            CHECK(x == Approx(y).epsilon(1e-7).margin(1e-8 * scale));
          };
          same(p.v, q.v, 0.5), same(p.x, q.x, 0.5);
          same(p.v_v0, q.v_v0, 1), same(p.x_v0, q.x_v0, 1);
          same(p.v_c[0], q.v_a, 100), same(p.v_c[1], q.v_b, 1), same(p.v_c[2], q.v_S, 10);
          same(p.x_c[0], q.x_a, 100), same(p.x_c[1], q.x_b, 1), same(p.x_c[2], q.x_S, 10);
        }
        if (std::isinf(exact.stop_time())) continue;
        const auto p = rolled.at(exact.stop_time() + 1);
        const auto q = exact.at(exact.stop_time() + 1);
        CHECK(p.v <= 1e-6 * 0.5);  // on a falling mat the law may leave a speed that counts as rest
        CHECK(p.x == Approx(q.x).epsilon(1e-8));
        CHECK(p.x_c[0] == Approx(q.x_a).epsilon(1e-7));
        CHECK(std::abs(p.v_c[0]) < 1e-5);
      }
}

TEST_CASE("law roll: where D of a v^b reaches R it stays there, as in the trajectory", "[law]") {
  Body body{1.375, 0.04, 0.5};
  for (const double slope : {0.0, 2e-3, -1e-3})
    for (const double b : {-0.05, -0.3, -0.5}) {
      body.slope = slope;
      const double c[]{2e-3, b};
      const Trajectory exact(body, Geometry::exact, {c[0], c[1]}, 0.5,
                             Trajectory::Derivatives::of_law_and_slope,
                             Trajectory::AtRadius::passed);
      LawRoll rolled(body, Geometry::exact, {&laws()[0], 1, 1}, c, 0.5);
      for (const double part : {0.3, 0.9, 0.99, 1.01, 2.0}) {
        const double t = part * exact.stop_time();
        const auto p = rolled.at(t);
        const auto q = exact.at(t);
        CAPTURE(slope, b, t);
        CHECK(p.v == Approx(q.v).epsilon(1e-7).margin(1e-12));
        CHECK(p.x == Approx(q.x).epsilon(1e-8));
        CHECK(p.x_c[0] == Approx(q.x_a).epsilon(1e-5));
        CHECK(p.x_c[1] == Approx(q.x_b).epsilon(1e-5));
        CHECK(p.x_c[2] == Approx(q.x_S).epsilon(1e-5));
        CHECK(p.x_v0 == Approx(q.x_v0).epsilon(1e-7));
      }
    }
}

TEST_CASE("law roll: closed forms of the other laws", "[law]") {
  const double line[]{0.1, 0.2}, square[]{0.1, 0.4}, below[]{-0.05, 0.2}, peak[]{0, 0.3, 0.4};
  LawRoll by_line = roll(2, line), by_square = roll(4, square), by_below = roll(2, below),
          by_peak = roll(6, peak);
  for (double t = 0; t < 40; t += 0.37) {
    CAPTURE(t);
    const bool rolls = t < 5 * std::log(3);
    CHECK(by_line.at(t).v ==
          Approx(rolls ? 1.5 * std::exp(-0.2 * t) - 0.5 : 0).epsilon(1e-8).margin(1e-10));
    if (rolls)
      CHECK(by_line.at(t).x == Approx(7.5 * (1 - std::exp(-0.2 * t)) - 0.5 * t).epsilon(1e-9));
    if (t < 5 * std::atan(2))
      CHECK(by_square.at(t).v ==
            Approx(0.5 * std::tan(std::atan(2) - 0.2 * t)).epsilon(1e-8).margin(1e-10));
    // It tends to 0.25 and never stops.
    CHECK(by_below.at(t).v == Approx(0.25 + 0.75 * std::exp(-0.2 * t)).epsilon(1e-7));
    CHECK(by_below.at(t).x ==
          Approx(0.25 * t + 3.75 * (1 - std::exp(-0.2 * t))).epsilon(1e-7).margin(1e-12));
    // int (v^2 + w^2)/(2 p w v) dv = -t
    const double v = by_peak.at(t).v;
    CHECK((1 - v * v) / 2 - 0.16 * std::log(v) == Approx(0.24 * t).epsilon(1e-8).margin(1e-10));
  }
}

TEST_CASE("law roll: derivatives are limits of differences for every law", "[law]") {
  constexpr double h = 1e-5;
  for (std::size_t law = 0; law < laws().size(); ++law) {
    const double c[]{0.2, 0.15, 0.7};
    for (double t : {0.5, 2.0, 3.5})
      for (std::size_t j = 0; j < laws()[law].coefficients.size(); ++j) {
        double low[]{c[0], c[1], c[2]}, high[]{c[0], c[1], c[2]};
        low[j] -= h, high[j] += h;
        const auto p = roll(law, c).at(t), a = roll(law, low).at(t), b = roll(law, high).at(t);
        CAPTURE(laws()[law].formula, t, j);
        CHECK(p.v_c[j] == Approx((b.v - a.v) / (2 * h)).epsilon(1e-5).margin(1e-6));
        CHECK(p.x_c[j] == Approx((b.x - a.x) / (2 * h)).epsilon(1e-5).margin(1e-6));
      }
  }
}

TEST_CASE("law roll: asked for many times, it is as where it is asked once", "[law]") {
  const std::vector<std::vector<double>> c{{0.1, 0.4},       {0.1},      {0.1, 0.2},
                                           {0.1, 0.3, -0.1}, {0.1, 0.4}, {0.05, 0.2, 1.3},
                                           {0.05, 0.3, 0.4}};
  for (std::size_t law = 0; law < laws().size(); ++law) {
    LawRoll often = roll(law, c[law].data());
    for (int i = 0; i < 40000; ++i) {
      const double t = 3e-4 * i;
      const auto p = often.at(t);
      if (i % 97) continue;
      const auto q = roll(law, c[law].data()).at(t);
      CAPTURE(law, t);
      const auto same = [&](double x, double y) {
        CHECK(x == Approx(y).epsilon(1e-11).margin(1e-11));
      };
      same(p.v, q.v), same(p.x, q.x), same(p.v_v0, q.v_v0), same(p.x_v0, q.x_v0);
      for (std::size_t j = 0; j < LawRoll::most; ++j)
        same(p.v_c[j], q.v_c[j]), same(p.x_c[j], q.x_c[j]);
    }
  }
}

TEST_CASE("law roll: what does not slow down, and what cannot be, is refused", "[law]") {
  const double rising[]{-0.1, 0.05}, steep[]{1, 740};
  CHECK_THROWS_AS(roll(2, rising), Error);
  CHECK_THROWS_AS(roll(1, rising), Error);
  const double good[]{0.1};
  for (double v0 : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(roll(1, good, v0), Error);
  CHECK_THROWS_AS(roll(0, steep).at(1e300), Error);
  const double deep[]{2.0};
  CHECK_THROWS_AS(LawRoll(unit, Geometry::exact, {&laws()[1], 1, 1}, deep, 1), Error);
}
