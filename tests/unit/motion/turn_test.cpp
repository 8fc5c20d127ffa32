// SPDX-License-Identifier: GPL-3.0-or-later
// Up a slope, the turning point, and back.
#include "motion/roll.h"

#include <cmath>
#include <vector>

#include "motion/scene.h"
#include "unit/catch.h"
#include "unit/exact_body.h"

using namespace rolling;

namespace {

constexpr bool paper = false, exact = true;

struct State {
  double t, v, x;
};

struct Turning {
  double K, R, a, b, S;
  bool is_exact;
  std::vector<State> states;  // the turning point first
};

// v0 = 0.5. By two programs, with 40 digits and by a solver.
const Turning rolls[] = {{0.4,
                          0.0127,
                          5e-5,
                          0.1,
                          0.02,
                          paper,
                          {{3.0584508597696927, 0, 0.75934488488203117},
                           {1, 0.33462714969949501, 0.41722953150724698},
                           {5, -0.22994932620668731, 0.53419892064384562},
                           {7, -0.46066181813163641, -0.15697524091188062}}},
                         {0.4,
                          0.0127,
                          5e-5,
                          0.1,
                          0.02,
                          exact,
                          {{3.0584532784378134, 0, 0.75934551954130936},
                           {5, -0.22994853021399576, 0.53420056117413618},
                           {7, -0.46066031718456993, -0.1569713222685036}}},
                         {0.5,
                          0.04,
                          1.87e-3,
                          0.215,
                          0.1,
                          paper,
                          {{0.57827355563008882, 0, 0.14095729366447649},
                           {1, -0.19897139100791221, 0.097536322483330141},
                           {5, -1.6225927830719671, -3.6898741422057731},
                           {7, -2.2239553110777277, -7.5442849610929151}}},
                         {0.5,
                          0.04,
                          1.87e-3,
                          0.215,
                          0.1,
                          exact,
                          {{0.57829809453498657, 0, 0.14096329117298266},
                           {5, -1.6209726223584305, -3.6869087641617097},
                           {7, -2.2211987449384197, -7.5369717958253566}}}};

Roll roll(double S, PowerLaw law, double v0, bool is_exact) {
  return {exact_body({1, 0.04, 0.5, 9.81, S}, is_exact), law, v0};
}

}  // namespace

TEST_CASE("Roll: up a slope, the turning point, and back", "[rolling]") {
  for (const Turning& r : rolls) {
    Roll roll(exact_body({1, r.R, r.K, 9.81, r.S}, r.is_exact), PowerLaw{r.a, r.b}, 0.5);
    CHECK(roll.turns());
    CHECK(roll.stop_time() == Approx(r.states[0].t).epsilon(1e-13));
    CHECK(roll.at(roll.stop_time()).v == 0);
    for (const State& s : r.states) {
      const auto p = roll.at(s.t);
      CAPTURE(r.K, r.S, s.t);
      CHECK(std::abs(p.v - s.v) < 1e-13);
      CHECK(std::abs(p.x - s.x) < 1e-13);
    }
  }
}

TEST_CASE("Roll: on the way back its derivatives are limits of differences", "[rolling]") {
  for (const Turning& r : rolls) {
    const auto at = [&](PowerLaw law, double S, double v0) {
      return Roll(exact_body({1, r.R, r.K, 9.81, S}, r.is_exact), law, v0).at(5);
    };
    const PowerLaw law{r.a, r.b};
    const auto p = at(law, r.S, 0.5);
    // Differences of the fourth order.
    const auto check = [&](double v_p, double x_p, double h, auto&& changed) {
      const auto up = changed(h), down = changed(-h), up2 = changed(2 * h), down2 = changed(-2 * h);
      CHECK(v_p == Approx((8 * (up.v - down.v) - up2.v + down2.v) / (12 * h)).epsilon(1e-8));
      CHECK(x_p == Approx((8 * (up.x - down.x) - up2.x + down2.x) / (12 * h)).epsilon(1e-8));
    };
    CAPTURE(r.K, r.S);
    check(p.v_c[0], p.x_c[0], 1e-3 * r.a, [&](double h) { return at({r.a + h, r.b}, r.S, 0.5); });
    check(p.v_c[1], p.x_c[1], 1e-4, [&](double h) { return at({r.a, r.b + h}, r.S, 0.5); });
    check(p.v_c[2], p.x_c[2], 1e-3 * r.S, [&](double h) { return at(law, r.S + h, 0.5); });
    check(p.v_v0, p.x_v0, 1e-3, [&](double h) { return at(law, r.S, 0.5 + h); });
    Roll same(exact_body({1, r.R, r.K, 9.81, r.S}, r.is_exact), law, 0.5);
    check(p.a, p.v, 1e-2, [&](double h) { return same.at(5 + h); });
  }
}

TEST_CASE(
    "Roll: b > 0 rolls back from a slope whose balance is seen, b = 0 beyond D/R, b < 0 never",
    "[rolling]") {
  for (const bool is_exact : {false, true}) {
    CHECK_FALSE(roll(0.0249, {1e-3, 0}, 0.5, is_exact).turns());
    CHECK(roll(0.0251, {1e-3, 0}, 0.5, is_exact).turns());
    CHECK_FALSE(roll(0.5, {1e-3, -0.2}, 0.5, is_exact).turns());
    CHECK_FALSE(roll(1e-3, {5.75e-4, 0.0244}, 0.5, is_exact).turns());
    CHECK(roll(0.01, {1.87e-3, 0.215}, 0.5, is_exact).turns());
    CHECK_FALSE(roll(0, {1.87e-3, 0.215}, 0.5, is_exact).turns());
    CHECK_FALSE(roll(-0.1, {1.87e-3, 0.215}, 0.5, is_exact).turns());
    Roll held = roll(0.0249, {1e-3, 0}, 0.5, is_exact);
    CHECK((held.at(100).v == 0 && held.at(100).x == held.at(held.stop_time()).x));
    // The way back tends to the speed at which the law balances the slope.
    Roll back = roll(0.05, {1.87e-3, 0.5}, 0.5, is_exact);
    const double D = is_exact ? 0.04 * std::sin(std::atan(0.05)) : 0.04 * 0.05,
                 last = -std::pow(D / 1.87e-3, 2);
    CHECK(back.last_speed() == Approx(last).epsilon(1e-12));
    CHECK(back.at(1e4).v == Approx(last).epsilon(1e-12));
  }
}

TEST_CASE("Roll: a body that the mat does not hold rolls down from rest", "[rolling]") {
  for (const bool is_exact : {false, true})
    for (const double S : {0.1, -0.1}) {  // v = a t, since D does not depend on v
      Roll from_rest = roll(S, {1e-3, 0}, 0, is_exact);
      const auto p = from_rest.at(2), q = from_rest.at(4);
      CHECK((from_rest.turns() && from_rest.stop_time() == 0));
      CHECK(p.v * S < 0);
      CHECK(q.v == Approx(2 * p.v).epsilon(1e-12));
      CHECK(q.x == Approx(2 * q.v).epsilon(1e-12));
      CHECK(roll(S / 5, {1e-3, 0}, 0, is_exact).at(3).x == 0);
    }
}

TEST_CASE("Scene: the solvers turn where the integral over speed does", "[rolling]") {
  for (const Turning& r : rolls) {
    const Scene scene{
        exact_body({1, r.R, r.K, 9.81, r.S}, r.is_exact), PowerLaw{r.a, r.b}, {0}, 0.5, 0.1};
    for (const Stepper stepper :
         {gsl_odeiv2_step_rk8pd, gsl_odeiv2_step_rkf45, gsl_odeiv2_step_rk4imp}) {
      const auto best = start(scene, {Method::exact}, 0),
                 solver = start(scene, {Method::solver, stepper}, 1e-11);
      CHECK(solver->stop_time() == Approx(best->stop_time()).epsilon(1e-8));
      for (const double t : {0.4, 1.0, 5.0, 7.0}) {
        best->seek(t), solver->seek(t);
        CAPTURE(stepper->name, t);
        CHECK(std::abs(best->velocity() - solver->velocity()) < 2e-8);
        CHECK(std::abs(best->position() - solver->position()) < 2e-8);
        CHECK(std::abs(best->acceleration() - solver->acceleration()) < 1e-7);
        CHECK(std::abs(best->shift() - solver->shift()) < 1e-9);
      }
    }
  }
}
