// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/roll.h"

#include "base/error.h"
#include "unit/catch.h"
#include "unit/exact_body.h"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

using namespace rolling;

namespace {

const Body unit{1, 1, 0, 1};  // with A = 1, g/((K + 1) R) = 1: D is the deceleration

Roll roll(std::size_t law, std::span<const double> c, double v0 = 1) {
  return {unit, Law(laws()[law], c), v0};
}

}  // namespace

TEST_CASE("Roll: closed forms of the other laws", "[law]") {
  const double line[]{0.1, 0.2}, square[]{0.1, 0.4}, below[]{-0.05, 0.2}, peak[]{0, 0.3, 0.4};
  Roll by_line = roll(2, line), by_square = roll(4, square), by_below = roll(2, below),
       by_peak = roll(6, peak);
  for (double t = 0; t < 40; t += 0.37) {
    CAPTURE(t);
    const bool rolls = t < 5 * std::log(3);
    CHECK(by_line.at(t).v ==
          Approx(rolls ? 1.5 * std::exp(-0.2 * t) - 0.5 : 0).epsilon(1e-13).margin(1e-13));
    if (rolls)
      CHECK(by_line.at(t).x ==
            Approx(7.5 * (1 - std::exp(-0.2 * t)) - 0.5 * t).epsilon(1e-13).margin(1e-13));
    if (t < 5 * std::atan(2))
      CHECK(by_square.at(t).v ==
            Approx(0.5 * std::tan(std::atan(2) - 0.2 * t)).epsilon(1e-13).margin(1e-13));
    // It tends to 0.25 and never stops.
    CHECK(by_below.at(t).v == Approx(0.25 + 0.75 * std::exp(-0.2 * t)).epsilon(1e-13));
    CHECK(by_below.at(t).x ==
          Approx(0.25 * t + 3.75 * (1 - std::exp(-0.2 * t))).epsilon(1e-13).margin(1e-13));
    // int (v^2 + w^2)/(2 p w v) dv = -t
    const double v = by_peak.at(t).v;
    CHECK((1 - v * v) / 2 - 0.16 * std::log(v) == Approx(0.24 * t).epsilon(1e-13).margin(1e-13));
  }
}

TEST_CASE("Roll: derivatives are limits of differences for every law", "[law]") {
  constexpr double h = 1e-5;
  for (std::size_t law = 0; law < laws().size(); ++law) {
    const double c[]{0.2, 0.15, 0.7};
    for (double t : {0.5, 2.0, 3.5})
      for (std::size_t j = 0; j < laws()[law].coefficients.size(); ++j) {
        double low[]{c[0], c[1], c[2]}, high[]{c[0], c[1], c[2]};
        low[j] -= h, high[j] += h;
        const auto p = roll(law, c).at(t), a = roll(law, low).at(t), b = roll(law, high).at(t);
        CAPTURE(laws()[law].formula, t, j);
        CHECK(p.v_c[j] == Approx((b.v - a.v) / (2 * h)).epsilon(1e-8).margin(1e-9));
        CHECK(p.x_c[j] == Approx((b.x - a.x) / (2 * h)).epsilon(1e-8).margin(1e-9));
      }
  }
}

// Also where the air comes to rest beside the body, and where a head wind blows it back.
TEST_CASE("Roll: the derivatives in a wind are limits of differences", "[law]") {
  constexpr double h = 1e-5;
  for (const std::size_t law : {3u, 4u})
    for (const double wind : {0.0, 0.4, -0.5, 1.5})
      for (const double slope : {0.0, 0.02})
        for (const double t : {0.3, 1.3, 4.0}) {
          const double c[]{0.2, law == 4 ? 0.3 : 0.15, 0.3};
          const auto at = [&](std::array<double, 6> q) {
            const Body body{1, 1, 0, 1, slope + q[4], 0, 0, 0, 0, wind + q[5]};
            const double moved[]{c[0] + q[1], c[1] + q[2], c[2] + q[3]};
            return Roll(body, Law(laws()[law], moved), 1 + q[0]).at(t);
          };
          const std::size_t size = laws()[law].coefficients.size();
          const Roll::Point p = at({});
          for (std::size_t j = 0; j < 6; ++j) {
            if (j > size && j < 4) continue;
            std::array<double, 6> q{};
            q[j] = h;
            const Roll::Point more = at(q);
            q[j] = -h;
            const Roll::Point less = at(q);
            const std::size_t i = j < 4 ? j - 1 : size + j - 4;
            CAPTURE(law, wind, slope, t, j);
            CHECK((j == 0 ? p.v_v0 : p.v_c[i]) ==
                  Approx((more.v - less.v) / (2 * h)).epsilon(1e-7).margin(1e-8));
            CHECK((j == 0 ? p.x_v0 : p.x_c[i]) ==
                  Approx((more.x - less.x) / (2 * h)).epsilon(1e-7).margin(1e-8));
          }
        }
}

TEST_CASE("Roll: asked for in any order, it is as where it is asked once", "[law]") {
  const std::vector<std::vector<double>> c{{0.1, 0.4},       {0.1},      {0.1, 0.2},
                                           {0.1, 0.3, -0.1}, {0.1, 0.4}, {0.05, 0.2, 1.3},
                                           {0.05, 0.3, 0.4}};
  for (std::size_t law = 0; law < laws().size(); ++law) {
    Roll often = roll(law, c[law]);
    for (const double t : {12.0, 3.0, 0.1, 7.0, 0.0}) {
      const auto p = often.at(t), q = roll(law, c[law]).at(t);
      CAPTURE(law, t);
      CHECK((p.v == q.v && p.x == q.x && p.v_c == q.v_c && p.x_c == q.x_c));
    }
  }
}

TEST_CASE("Roll: a shift against the motion's drag speeds a body up, on a level mat too", "[law]") {
  const std::vector<double> rising{-0.1, 0.05};  // v' = 0.1 - 0.05 v tends to 2
  Roll up = roll(2, rising);
  CHECK(up.at(3).v == Approx(2 - std::exp(-0.15)).epsilon(1e-13));
  CHECK(up.last_speed() == Approx(2).epsilon(1e-13));
  CHECK(std::isinf(up.stop_time()));
}

TEST_CASE("Roll: what cannot be is refused", "[law]") {
  const double good[]{0.1}, deep[]{2.0};
  for (double v0 : {-1.0, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(roll(1, good, v0), Error);
  CHECK_THROWS_AS(Roll(exact_body(unit), Law(laws()[1], deep), 1), Error);
}
