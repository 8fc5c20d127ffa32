// SPDX-License-Identifier: GPL-3.0-or-later
// Rolls on a mat that is not level: against quadrature in mpmath, against the level mat, and at the
// ends of the range.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "base/error.h"
#include "motion/roll.h"
#include "motion/scene.h"
#include "unit/catch.h"
#include "unit/exact_body.h"

using namespace rolling;

namespace {

struct SlopeReference {
  int exact;
  double K, a, b, v0, S, t, v, x, v_a, v_b, v_v0, v_S, x_a, x_b, x_v0, x_S;
};

const SlopeReference references[] = {
#include "unit/motion/slope_reference.inc"
};

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr bool paper = false, exact = true;

double deceleration(const SlopeReference& r, double v) {
  const double d = r.a * std::pow(v, r.b) / 0.04, A = r.exact ? std::sqrt(1 - d * d) : 1;
  return 9.81 * (d + A * r.S) / std::sqrt(1 + r.S * r.S) / (r.K + A);
}

}  // namespace

TEST_CASE("Slope: speed, distance and derivatives against quadrature with 34 digits", "[rolling]") {
  for (const SlopeReference& r : references) {
    Roll roll(exact_body({1, 0.04, r.K, 9.81, r.S}, r.exact), PowerLaw{r.a, r.b}, r.v0);
    const auto s = roll.at(r.t);
    INFO("exact " << r.exact << " K " << r.K << " a " << r.a << " b " << r.b << " v0 " << r.v0
                  << " S " << r.S << " t " << r.t);
    // Near the speed where the law balances the slope, rounding shows in the net force.
    const double slowing = std::abs(deceleration(r, r.v)), start = std::abs(deceleration(r, r.v0));
    const double balance = 9.81 * std::abs(r.S) / r.K, off = 1 + balance / std::min(slowing, start),
                 fastest = std::max(r.v, r.v0), T = r.v0 / start;
    CHECK(std::abs(s.v - r.v) <= 3e-13 * fastest);
    CHECK(std::abs(s.x - r.x) <= 1e-13 * std::max(r.x, r.v0 * T));
    const auto close = [&](double value, double expected, double scale) {
      CHECK(std::abs(value - expected) <=
            (1e-9 + 1e-14 * off + 40 * eps * r.t * slowing / r.v) * scale);
    };
    const double log_u = std::abs(std::log(r.v0)) + std::abs(std::log(r.v));
    const double of_v = std::abs(r.v_a) + r.v0 / r.a, of_x = std::abs(r.x_a) + r.v0 * T / r.a;
    close(s.v_c[0], r.v_a, of_v);
    close(s.v_c[1], r.v_b, r.a * of_v * log_u);
    close(s.v_v0, r.v_v0, 1 + r.v_v0);
    close(s.v_c[2], r.v_S, std::abs(r.v_S) + std::abs(r.S) * slowing * r.t + r.v0);
    close(s.x_c[0], r.x_a, of_x);
    close(s.x_c[1], r.x_b, r.a * of_x * log_u);
    close(s.x_v0, r.x_v0, T + r.x_v0);
    close(s.x_c[2], r.x_S, std::abs(r.x_S) + std::abs(r.S) * slowing * r.t * r.t + r.v0 * T);
  }
}

TEST_CASE("Slope: the checked stops and ways of the paper's scenes", "[rolling]") {
  struct Checked {
    double a, b, S, paper, exact, way;
  };
  // By quadrature in mpmath, 30 digits.
  const Checked checked[] = {
      {5.75e-4, 0.0244, 1e-3, 5.16933841680935289, 5.16904378124872321, 1.27747830755234561},
      {5.75e-4, 0.0244, -1e-3, 5.97829059603864876, 5.97786705095466527, 1.47463011267869249},
      {1.87e-3, 0.215, 1e-3, 2.33847791270875178, 2.3376934921966471, 0.517107571078690025},
      {1.87e-3, 0.215, 5e-3, 2.07062983759309742, 2.07003800529656266, 0.466070471605214366},
  };
  for (const Checked& c : checked) {
    const Body body{1, 0.04, 0.5, 9.81, c.S};
    Roll roll(body, PowerLaw{c.a, c.b}, 0.5);
    CHECK(std::abs(roll.stop_time() / c.paper - 1) < 1e-14);
    CHECK(std::abs(roll.at(roll.stop_time()).x / c.way - 1) < 1e-14);
    CHECK(std::abs(Roll(exact_body(body, exact), PowerLaw{c.a, c.b}, 0.5).stop_time() / c.exact -
                   1) < 1e-14);
  }
}

TEST_CASE("Slope: a slope that vanishes leads to the level mat", "[rolling]") {
  for (const bool is_exact : {false, true})
    for (const double b : {-0.3, 0.0, 0.215, 0.6})
      for (const double depth : {0.04, 0.6, 1.0})
        for (const double S : {0.0, 1e-300, -1e-300, 1e-27, -1e-27}) {
          if (is_exact && b < 0 && depth == 1) continue;  // ends at once
          const PowerLaw law{0.04 * depth * std::pow(0.5, -b) * (1 - 1e-12), b};
          Roll level(exact_body({1, 0.04, 0.5}, is_exact), law, 0.5),
              roll(exact_body({1, 0.04, 0.5, 9.81, S}, is_exact), law, 0.5);
          INFO("exact " << is_exact << " b " << b << " depth " << depth << " S " << S);
          const double stop = level.stop_time(), end = std::isinf(stop) ? 0.01 / depth : stop;
          if (!std::isinf(stop)) CHECK(std::abs(roll.stop_time() / stop - 1) < 1e-14);
          const auto half = level.at(0.5 * end);  // sums over the way begin with its rounding
          for (const double part : {1e-6, 0.1, 0.9, 1.1}) {
            if (part > 1 && std::isinf(stop)) continue;
            const auto s = roll.at(part * end), l = level.at(part * end);
            const double log_u = 1 + std::abs(std::log(s.v > 0 ? s.v : 1));
            const auto close = [](double x, double y, double scale, double of_way) {
              CHECK(std::abs(x - y) <= 1e-12 * std::abs(scale) + 1e-14 * std::abs(of_way));
            };
            close(s.v, l.v, l.v, 0);
            close(s.x, l.x, l.x, half.x);
            close(s.v_c[0], l.v_c[0], l.v_c[0], half.v_c[0]);
            close(s.v_c[1], l.v_c[1], law.a * l.v_c[0] * log_u, law.a * half.v_c[0]);
            close(s.v_v0, l.v_v0, l.v_v0, 0);
            close(s.x_c[0], l.x_c[0], l.x_c[0], half.x_c[0]);
            close(s.x_c[1], l.x_c[1], law.a * l.x_c[0] * log_u, law.a * half.x_c[0]);
            close(s.x_v0, l.x_v0, l.x_v0, half.x_v0);
            // By the slope: against a difference of the second order.
            const double h = 1e-6;
            const auto at = [&](double slope) {
              return Roll(exact_body({1, 0.04, 0.5, 9.81, slope}, is_exact), law, 0.5)
                  .at(part * end);
            };
            if (part < 1) {
              const auto up = at(h), down = at(-h);
              CHECK(std::abs(s.v_c[2] - (up.v - down.v) / (2 * h)) <=
                    2e-6 * std::abs(s.v_c[2]) + 1e-8);
              CHECK(std::abs(s.x_c[2] - (up.x - down.x) / (2 * h)) <=
                    2e-6 * std::abs(s.x_c[2]) + 1e-10);
            }
          }
        }
}

TEST_CASE("Slope: random rolls are finite and monotone, uphill, downhill and for ever",
          "[rolling]") {
  std::mt19937_64 random(8);
  const auto between = [&](double lo, double hi) {
    return std::uniform_real_distribution(lo, hi)(random);
  };
  for (int i = 0; i < 3000; ++i) {
    const double b = i % 7 == 0    ? 1 + between(-1e-15, 1e-15)
                     : i % 11 == 0 ? 0
                     : i % 13 == 0 ? std::copysign(std::pow(10, between(-20, 3)), between(-1, 1))
                                   : between(-0.5, 3);
    const double v0 = i % 13 == 0 ? 1 : std::pow(10, between(-6, 3)), K = between(0, 1);
    const double depth = i % 3 ? std::pow(10, between(-9, 0)) : 1;
    const double S = i % 5 == 0 ? -depth * (1 + between(-1e-15, 1e-15))
                                : std::copysign(std::pow(10, between(-12, 0.5)), between(-1, 1));
    const bool is_exact = i % 2 == 1;
    const Body body{1, 0.04, K, 9.81, S};
    const PowerLaw law{0.04 * depth * std::pow(v0, -b) * (1 - 1e-12), b};
    INFO("i " << i << " b " << b << " K " << K << " depth " << depth << " S " << S << " exact "
              << is_exact << " v0 " << v0);
    Roll roll(exact_body(body, is_exact), law, v0);
    const double unit = v0 * 0.04 / (9.81 * law(v0));
    REQUIRE(roll.stop_time() >= 0);
    if (S > 0 && !(is_exact && b < 0)) REQUIRE(std::isfinite(roll.stop_time()));
    double v = v0, x = -1;
    int way = 0;
    for (double t = 1e-12 * unit; t < 1e6 * unit; t *= 3) {
      if (roll.turns() && t > roll.stop_time()) break;
      Roll::Point s{};
      try {
        s = roll.at(t);
      } catch (const Error&) {
        REQUIRE((std::isinf(roll.last_speed()) || (is_exact && b < 0)));
        break;
      }
      const double change = s.v - v;
      if (way == 0 && std::abs(change) > 1e-14 * v) way = change > 0 ? 1 : -1;
      if (s.v > 0) REQUIRE(way * change >= -1e-13 * v);
      REQUIRE(s.v >= 0);
      // At a speed that the law balances to the last digits, a moment is nothing beside a panel.
      if (i % 5 != 0) REQUIRE(s.x >= x * (1 - 8 * eps));
      if (S >= 0) REQUIRE(s.v <= v0);
      for (const double d :
           {s.v_c[0], s.v_c[1], s.v_v0, s.v_c[2], s.x_c[0], s.x_c[1], s.x_v0, s.x_c[2]})
        REQUIRE(std::isfinite(d));
      v = s.v, x = s.x;
    }
    if (std::isfinite(roll.last_speed()) && roll.last_speed() > 0)
      CHECK(std::abs(roll.at(1e200 * unit).v / roll.last_speed() - 1) < 1e-12);
  }
}

TEST_CASE("Slope: what never stops, what counts as rest, and rest itself", "[rolling]") {
  const auto roll = [](double S, double a, double b, double v0, bool is_exact = false) {
    return Roll(exact_body({1, 0.04, 0.5, 9.81, S}, is_exact), PowerLaw{a, b}, v0);
  };
  const double balance = std::pow(0.04 * 0.005 / 1.87e-3, 1 / 0.215);
  auto slow = roll(-5e-3, 1.87e-3, 0.215, 0.5);
  CHECK((std::isinf(slow.stop_time()) && std::abs(slow.last_speed() / balance - 1) < 1e-13));
  CHECK(std::abs(slow.at(100).v / balance - 1) < 1e-13);
  CHECK(std::abs(roll(-5e-3, 1.87e-3, 0.215, 1e-6).at(100).v / balance - 1) < 1e-13);
  CHECK(std::isinf(roll(-0.1, 1e-3, 0, 0.5).last_speed()));
  CHECK(roll(-0.025, 1e-3, 0, 0.5).at(7).v == 0.5);
  CHECK(std::isinf(roll(-0.025, 1e-3, 0, 0.5).stop_time()));
  CHECK(std::isfinite(roll(1e-3, 1e-3, 1.5, 0.5).stop_time()));  // uphill even b >= 1 stops
  auto rest = roll(-1e-3, 1.87e-3, 0.215, 0.5);
  const double negligible = std::pow(0.04 * 0.001 / 1.87e-3, 1 / 0.215);
  const double stop = rest.stop_time();
  CHECK(std::abs(rest.rest_speed() / negligible - 1) < 2e-7);
  CHECK(std::abs(rest.at(stop * (1 - 1e-12)).v / negligible - 1) < 2e-7);
  CHECK(std::abs(rest.at(stop).x_c[0] / rest.at(stop * (1 - 1e-12)).x_c[0] - 1) < 1e-9);
  CHECK(rest.at(rest.stop_time()).v == 0);
  CHECK(roll(0.5, 1e-3, -0.2, 0).at(3).v == 0);
  CHECK_THROWS_AS(roll(infinity, 1e-3, 0.2, 0.5), Error);
  CHECK_THROWS_AS(roll(std::nan(""), 1e-3, 0.2, 0.5), Error);
}

TEST_CASE("Slope: where the law balances it, a solver stops when the integral over speed does",
          "[rolling]") {
  for (int i = 0; i < 40; ++i) {
    Scene roll{};
    roll.body = {1, 0.04, 0.5, 9.81, -8e-4 - 1e-5 * i};
    roll.law = PowerLaw{1.87e-3, 0.215}, roll.v0 = 0.5;
    const double stop = start(roll, best_method(roll), 0)->stop_time();
    INFO("S " << roll.body.slope);
    for (const Stepper stepper : {gsl_odeiv2_step_rk8pd, gsl_odeiv2_step_rkf45})
      CHECK(std::abs(start(roll, {Method::solver, stepper}, 1e-12)->stop_time() / stop - 1) < 1e-8);
  }
}

TEST_CASE("Slope: solvers, tables and the integral over speed agree", "[rolling]") {
  for (const bool is_exact : {false, true})
    for (const double S : {1e-3, -1e-3, 0.02, -5e-3, -0.1}) {
      Scene roll{};
      roll.body = {1, 0.04, 0.5, 9.81, S}, roll.body.exact = is_exact;
      roll.law = PowerLaw{1.87e-3, 0.215}, roll.v0 = 0.5, roll.x0 = 0.1;
      INFO("S " << S << " exact " << is_exact);
      const auto best = start(roll, best_method(roll), 0),
                 solver = start(roll, {Method::solver, gsl_odeiv2_step_rk8pd}, 1e-12);
      CHECK(best_method(roll).kind == Method::exact);
      CHECK_THROWS_AS(start(roll, {Method::closed}, 0), Error);
      const double stop = best->stop_time(), end = std::isfinite(stop) ? stop : 5;
      if (std::isfinite(stop)) CHECK(std::abs(solver->stop_time() / stop - 1) < 1e-7);
      else CHECK(std::isinf(solver->stop_time()));
      for (const double part : {0.1, 0.5, 0.9, 1.2}) {
        best->seek(part * end);
        solver->seek(part * end);
        CHECK(std::abs(solver->velocity() - best->velocity()) < 1e-9);
        CHECK(std::abs(solver->position() - best->position()) < 1e-9);
        CHECK(std::abs(solver->acceleration() - best->acceleration()) < 1e-6);
        const double h = 1e-5;
        if (part < 1) {
          const double v = best->velocity(), a = best->acceleration();
          const auto later = start(roll, best_method(roll), 0);
          later->seek(part * end + h);
          CHECK(std::abs((later->velocity() - v) / h - a) < 1e-3 * std::abs(a) + 1e-9);
        }
      }
      // A table of one point is a law of b = 0.
      roll.law = TableLaw(std::vector{1.0}, std::vector{1.5e-3});
      Scene constant = roll;
      constant.law = PowerLaw{1.5e-3, 0};
      const auto table = start(roll, best_method(roll), 1e-12),
                 power = start(constant, best_method(constant), 0);
      if (S > -0.03) {
        CHECK(std::abs(table->stop_time() / power->stop_time() - 1) < 1e-13);
        table->seek(0.3), power->seek(0.3);
        CHECK(std::abs(table->velocity() / power->velocity() - 1) < 1e-12);
      } else {
        table->seek(0.3), power->seek(0.3);
        CHECK(std::abs(table->velocity() / power->velocity() - 1) < 1e-9);
        CHECK_THROWS_AS(table->seek(30), Error);  // above the table
      }
    }
}

// Far from there it is not small: it balances gravity downhill, and stops the body uphill. By
// quadrature in mpmath with 50 digits.
TEST_CASE("Slope: a law whose shift at v0 is near the least double or below it", "[rolling]") {
  struct Checked {
    bool is_exact;
    double b, v0, S, v, t, x;
  };
  for (const Checked& c :
       {Checked{paper, 100, 1e-3, -0.1, 1.01, 1.56787918458555671, 0.80119687389185236},
        {paper, 100, 1e-4, -0.1, 1.01, 1.56926219499213298, 0.80119763454757598},
        {paper, 1000, 1e-3, -0.1, 1, 1.53558321517821959, 0.76877960019684482},
        {paper, -100, 1000, 0.1, 1.1, 1534.98788316695821, 768338.185073920911},
        {paper, -100, 4000, 0.1, 0.98, 6145.19080795095688, 12293425.0822686111},
        {exact, 100, 1e-3, -0.1, 1.01, 1.56793050006562712, 0.80124857537813645},
        {exact, 100, 1e-4, -0.1, 1.01, 1.56931351047220339, 0.80124933603386007},
        {exact, 1000, 1e-3, -0.1, 1, 1.53558337290270565, 0.76877975785792993},
        {exact, -100, 1000, 0.1, 1.1, 1534.98788316695821, 768338.185073920911},
        {exact, -100, 4000, 0.1, 0.98, 6145.19079696202719, 12293425.0822578213}}) {
    INFO("b " << c.b << " v0 " << c.v0);
    Roll roll(exact_body({1, 0.04, 0.5, 9.81, c.S}, c.is_exact), PowerLaw{1e-3, c.b}, c.v0);
    const auto p = roll.at(c.t);
    // The time has a relative error of a few eps, and |dv/dt| is below 2 m/s^2.
    CHECK(std::abs(p.v - c.v) < 2e-12 * c.v + 16 * eps * c.t);
    CHECK(std::abs(p.x / c.x - 1) < 1e-12);
  }
}

// With the law at most 1e-90 of gravity the body falls freely down the mat.
TEST_CASE("Slope: down a wall, whatever the law", "[rolling]") {
  for (const double b : {-300.0, -3.0, 0.0, 0.2, 1.0})
    for (const double S : {-1e100, -1e150, -1e200, -1e300}) {
      Roll roll({1, 0.04, 0.5, 9.81, S}, PowerLaw{1e-3, b}, 2);
      for (const double t : {1e-3, 0.3, 2.0, 50.0}) {
        INFO("b " << b << " S " << S << " t " << t);
        CHECK(std::abs(roll.at(t).v / (2 + 6.54 * t) - 1) < 20 * eps);
        CHECK(std::abs(roll.at(t).x / (2 * t + 3.27 * t * t) - 1) < 1e-12);
      }
    }
}
