// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/scene.h"

#include <cmath>
#include <vector>

#include "base/error.h"
#include "unit/catch.h"

using namespace rolling;

TEST_CASE("Scene: the best method, and methods that do not fit the scene", "[rolling]") {
  Scene roll{};
  roll.body = {1.375, 0.04, 0.5}, roll.law = PowerLaw{1e-3, 0.2}, roll.v0 = 0.5;
  CHECK(best_method(roll).kind == Method::closed);
  CHECK(start(roll, {Method::closed}, 1e-8)->roll() != nullptr);
  CHECK(start(roll, {Method::solver}, 1e-8)->roll() == nullptr);
  roll.body.exact = true;
  CHECK(best_method(roll).kind == Method::exact);
  CHECK_THROWS_AS(start(roll, {Method::closed}, 1e-8), Error);
  roll.bulge.length = 1e-3;
  CHECK(best_method(roll).kind == Method::solver);
  CHECK_THROWS_AS(start(roll, {Method::exact}, 1e-8), Error);
  roll.law = TableLaw(std::vector{0.1, 1.0}, std::vector{1e-3, 2e-3});
  CHECK_THROWS_AS(start(roll, {Method::solver}, 1e-8), Error);
  roll.bulge.length = 0;
  CHECK(best_method(roll).kind == Method::exact);
  CHECK_THROWS_AS(start(roll, {Method::closed}, 1e-8), Error);
  roll.v0 = 1.5;
  CHECK_THROWS_AS(start(roll, {Method::exact}, 1e-8), Error);
  CHECK_THROWS_AS(start(roll, {Method::solver}, 1e-8), Error);
}

TEST_CASE("Scene: a start that is no position is refused by every method", "[rolling]") {
  Scene roll{};
  roll.body = {1.375, 0.04, 0.5}, roll.law = PowerLaw{1e-3, 0.2}, roll.v0 = 0.5;
  for (const double x0 : {INFINITY, -INFINITY, NAN}) {
    roll.x0 = x0;
    for (const Method method : {Method{Method::closed}, Method{Method::solver}})
      CHECK_THROWS_AS(start(roll, method, 1e-8), Error);
  }
}

// Where a tolerance times v0 is no number, or one of few digits, a solver prints what it likes.
TEST_CASE("Scene: every solver refuses a v0 that is too small for it, and is right above",
          "[rolling]") {
  Scene roll{};
  roll.body = {1.375, 0.04, 0.5}, roll.law = PowerLaw{1e-3, 0.5};
  for (const Stepper stepper : steppers) {
    INFO("stepper " << stepper->name);
    for (const double v0 : {5e-324, 1e-318, 1e-308, 1e-281}) {
      roll.v0 = v0;
      for (const double memory : {0.0, 1e-3}) {
        roll.bulge.length = memory;
        CHECK_THROWS_AS(start(roll, {Method::solver, stepper}, 1e-8), Error);
      }
    }
    roll.v0 = 1e-280;
    roll.bulge.length = 0;
    const double stop = start(roll, {Method::exact}, 1e-8)->stop_time();
    // Steps of the first order are as many as 1/rtol.
    const double rtol = stepper == gsl_odeiv2_step_rk1imp ? 1e-4 : 1e-8;
    CHECK(std::abs(start(roll, {Method::solver, stepper}, rtol)->stop_time() / stop - 1) < 1e-4);
  }
}
