// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/solved_roll.h"

#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "motion/scene.h"
#include "motion/roll.h"
#include "unit/catch.h"
#include "unit/many.h"
#include "unit/exact_body.h"

using namespace rolling;

namespace {

const Body cylinder{1.375, 0.04, 0.5};

Scene scene(double a, double b, const Body& body = cylinder, double v0 = 0.5) {
  Scene roll{};
  roll.body = body, roll.law = PowerLaw{a, b}, roll.v0 = v0;
  return roll;
}

/// Largest |v - exact| / v0 on the way to 1.2 times the stop, or to 5 s; requires v >= 0 and 0
/// after the stop.
double error(const Scene& roll, Stepper stepper, double rtol) {
  const auto exact = start(roll, best_method(roll), 0),
             motion = start(roll, {Method::solver, stepper}, rtol);
  const double end = std::isinf(exact->stop_time()) ? 5 : 1.2 * exact->stop_time();
  double worst = 0;
  for (int i = 0; i <= 200; ++i) {
    exact->seek(end * i / 200);
    motion->seek(end * i / 200);
    const double v = motion->velocity();
    REQUIRE(v >= 0);
    REQUIRE(std::isfinite(motion->position() + motion->acceleration() + motion->shift()));
    worst = std::max(worst, std::abs(v - exact->velocity()) / roll.v0);
  }
  CHECK((std::isinf(exact->stop_time()) || motion->velocity() == 0));
  CHECK(motion->evaluations() > 10);
  return worst;
}

}  // namespace

TEST_CASE(
    "IntegratedRoll: the explicit steppers find the law, the stop included, in both geometries",
    "[rolling]") {
  for (const bool is_exact : {false, true})
    for (const double b : {0.0, 1e-8, 0.0244, 0.215, 0.5, 0.9, 1.0, 1.5, 2.0}) {
      const Scene roll = scene(2e-3, b, exact_body(cylinder, is_exact));
      for (const Stepper stepper :
           {gsl_odeiv2_step_rkf45, gsl_odeiv2_step_rkck, gsl_odeiv2_step_rk8pd}) {
        INFO("b " << b << " stepper " << stepper->name << " exact " << is_exact);
        const double coarse = error(roll, stepper, 1e-6), fine = error(roll, stepper, 1e-10);
        CHECK(coarse < 1e-4);
        CHECK(fine < 1e-8);
      }
      for (const Stepper stepper :
           {gsl_odeiv2_step_rk4imp, gsl_odeiv2_step_msbdf, gsl_odeiv2_step_bsimp}) {
        INFO("b " << b << " stepper " << stepper->name);
        CHECK(error(roll, stepper, 1e-8) < 1e-5);
      }
    }
}

TEST_CASE("IntegratedRoll: the stop, also where v has long been below the tolerance (b near 1)",
          "[rolling]") {
  for (const bool is_exact : {false, true})
    for (const double b : {0.0, 1e-8, 0.215, 0.5, 0.9, 0.99})
      for (const Stepper stepper :
           {gsl_odeiv2_step_rkf45, gsl_odeiv2_step_rk8pd, gsl_odeiv2_step_rk4imp,
            gsl_odeiv2_step_bsimp, gsl_odeiv2_step_msbdf}) {
        const Scene roll = scene(2e-3, b, exact_body(cylinder, is_exact));
        const auto exact = start(roll, best_method(roll), 0),
                   motion = start(roll, {Method::solver, stepper}, 1e-10);
        const double stop = motion->stop_time();
        INFO("b " << b << " stepper " << stepper->name << " error "
                  << stop / exact->stop_time() - 1);
        CHECK(std::abs(stop / exact->stop_time() - 1) < 1e-7);
        for (const double part : {1 - 1e-6, 1.0}) {
          motion->seek(stop * part);
          exact->seek(stop * part);
          CHECK(std::abs(motion->position() - exact->position()) < 1e-8);
          CHECK(std::abs(motion->velocity() - exact->velocity()) < 1e-7);
        }
        CHECK(motion->velocity() == 0);
      }
}

TEST_CASE("IntegratedRoll: stop_time() does not move seek(), and is met", "[rolling]") {
  const auto exact = start(scene(1.87e-3, 0.215), {Method::closed}, 0);
  const auto motion = start(scene(1.87e-3, 0.215), {Method::solver, gsl_odeiv2_step_rk8pd}, 1e-10);
  const double stop = motion->stop_time();
  CHECK(std::abs(stop / exact->stop_time() - 1) < 1e-8);
  motion->seek(std::nextafter(stop, 0));
  CHECK(motion->velocity() < 1e-6);
  motion->seek(stop);
  CHECK((motion->velocity() == 0 && motion->shift() == 0 && motion->acceleration() == 0));
  exact->seek(10);
  CHECK(std::abs(motion->position() - exact->position()) < 1e-10);
  CHECK(std::isinf(
      start(scene(1.87e-3, 1), {Method::solver, gsl_odeiv2_step_rkf45}, 1e-8)->stop_time()));
}

// The speed there may be so small that it changes by more than a digit within a rounding of t, or
// below the one at which a solver ends.
TEST_CASE("IntegratedRoll: no stepper goes on where D has reached R, whatever it was asked before",
          "[rolling]") {
  InTurn in_turn;
  for (const double b : {-1e-9, -0.02, -0.1, -0.13, -0.25, -0.41, -0.46})
    for (const double depth : {0.3, 0.03, 1e-3, 1e-4}) {
      const Scene roll = scene(depth * cylinder.R * std::pow(0.5, -b), b, exact_body(cylinder));
      Roll exact(roll.body, roll.law, roll.v0);
      const double end = std::min(exact.stop_time(), exact.radius_time(exact.stop_time()));
      const bool stops = end == exact.stop_time();
      if (!stops && end > (1 - 1e-9) * exact.stop_time()) continue;  // below the floor
      for (const Stepper stepper : {gsl_odeiv2_step_rk2, gsl_odeiv2_step_rkf45,
                                    gsl_odeiv2_step_rk8pd, gsl_odeiv2_step_rk4imp})
        for (const double part : {0.0, 0.5, 0.9, 0.99, 0.9999}) {
          if (!in_turn()) continue;
          INFO("b " << b << " depth " << depth << " stepper " << stepper->name << " part " << part);
          const auto motion = start(roll, {Method::solver, stepper}, 1e-10);
          motion->seek(part * end);
          if (stops) CHECK_NOTHROW(motion->seek(1.3 * end));
          else CHECK_THROWS_AS(motion->seek(1.3 * end), Error);
        }
    }
}

TEST_CASE("IntegratedRoll: rest, and what is refused", "[rolling]") {
  const auto rest =
      start(scene(1e-3, 0.2, cylinder, 0), {Method::solver, gsl_odeiv2_step_rkf45}, 1e-8);
  CHECK(rest->stop_time() == 0);
  rest->seek(3);
  CHECK((rest->velocity() == 0 && rest->position() == 0));
  // b < 0 in exact geometry: D reaches R before the stop
  const auto grows = start(scene(2e-3, -0.5, exact_body(cylinder)),
                           {Method::solver, gsl_odeiv2_step_rk8pd}, 1e-10);
  std::string message;
  try {
    grows->seek(0.72);
  } catch (const Error& error) {
    message = error.what();
  }
  CHECK(message.ends_with(" s the shift has grown to the radius 0.04 m"));
  CHECK_THROWS_AS(start(scene(0.05, 0), {Method::solver, gsl_odeiv2_step_rkf45}, 1e-8), Error);
  CHECK_THROWS_AS(start(scene(1e-3, 0.2, cylinder, std::nan("")),
                        {Method::solver, gsl_odeiv2_step_rkf45}, 1e-8),
                  Error);
}

// Under a constant shift one step may reach far beyond the stop.
TEST_CASE("IntegratedRoll: the units of length and time do not matter", "[rolling]") {
  for (const bool is_exact : {false, true})
    for (const Stepper stepper : {gsl_odeiv2_step_rk8pd, gsl_odeiv2_step_rkf45,
                                  gsl_odeiv2_step_rk4imp, gsl_odeiv2_step_msbdf})
      for (const auto& [length, time] :
           {std::pair{0, 0}, {12, -40}, {100, -100}, {-200, 0}, {-20, 12}, {30, 200}}) {
        INFO(stepper->name << ", 2^" << length << " m, 2^" << time << " s");
        const double R = std::ldexp(0.04, length), D = R / 10, v0 = std::ldexp(0.5, length - time);
        const Body body{1, R, 0.5, std::ldexp(9.81, length - 2 * time)};
        const auto motion = start({exact_body(body, is_exact), PowerLaw{D, 0}, {0}, v0, 0},
                                  {Method::solver, stepper}, 1e-10);
        const double stop = -v0 / acceleration_from_shift(exact_body(body, is_exact), D);
        CHECK(std::abs(motion->stop_time() / stop - 1) < 1e-9);
      }
}
