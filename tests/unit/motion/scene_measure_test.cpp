// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/scene.h"

#include <cmath>

#include "base/error.h"
#include "motion/solved_roll.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

Scene scene(double b, double length = 0) {
  Scene roll{};
  roll.body = {1.375, 0.04, 0.5}, roll.law = PowerLaw{1.87e-3, b}, roll.v0 = 0.5,
  roll.bulge.length = length;
  return roll;
}

Measured run(const Scene& roll, Method method, double rtol) {
  return measure([&] { return start(roll, method, rtol); }, reference(roll, 50, 5));
}

}  // namespace

TEST_CASE(
    "measure: the reference itself, a solver that comes closer, and memory against a tighter "
    "tolerance",
    "[rolling]") {
  for (const double b : {0.215, 1.0}) {
    const Measured closed = run(scene(b), {Method::closed}, 0),
                   coarse = run(scene(b), {Method::solver, gsl_odeiv2_step_rkf45}, 1e-5),
                   fine = run(scene(b), {Method::solver, gsl_odeiv2_step_rkf45}, 1e-9);
    CHECK((closed.v_error == 0 && closed.stop_error == 0 && closed.evaluations == 0 &&
           closed.seconds > 0 && closed.failure.empty()));
    INFO("b " << b << " coarse " << coarse.v_error << " fine " << fine.v_error << " stop "
              << fine.stop_error);
    CHECK((coarse.v_error > (b < 1 ? 10 : 1) * fine.v_error && fine.v_error > 0 &&
           fine.v_error < 1e-6));
    CHECK((coarse.evaluations > 10 && coarse.evaluations <= fine.evaluations));
    CHECK((b >= 1 ? fine.stop_error == 0 : fine.stop_error > 0 && fine.stop_error < 1e-6));
  }
  const Measured memory = run(scene(0.215, 1e-4), {Method::solver, gsl_odeiv2_step_rk8pd}, 1e-8);
  CHECK((memory.v_error > 0 && memory.v_error < 1e-7 && memory.stop_error > 0));
}

TEST_CASE("measure: the reference goes beyond the stop, with memory to the stop", "[rolling]") {
  for (const double length : {0.0, 1e-4}) {
    const Reference right = reference(scene(0.215, length), 5, 5);
    CHECK(right.times.front() == 0);
    CHECK(right.times.back() == (length > 0 ? 1 : 1.2) * right.stop);
  }
}

TEST_CASE("measure: the stop by a method that is off shows in the errors", "[rolling]") {
  Scene other = scene(0.215);
  other.law = PowerLaw{1.01 * 1.87e-3, 0.215};
  const Reference right = reference(scene(0.215), 50, 5);
  const Measured off = measure([&] { return start(other, {Method::closed}, 0); }, right);
  CHECK((off.stop_error > 0.009 && off.stop_error < 0.011));
  CHECK((off.v_error > 1e-3 && off.v_error < 0.02));
}

TEST_CASE("measure: a failure says how", "[rolling]") {
  struct NoNumber final : Motion {
    double stop_time() override { return 1; }
    void seek(double) override {}
    double position() override { return 0; }
    double velocity() override { return std::nan(""); }
    double acceleration() override { return 0; }
    double shift() override { return 0; }
    unsigned long evaluations() const override { return 0; }
  };
  const Measured nan =
      measure([] { return std::make_unique<NoNumber>(); }, reference(scene(0.215), 5, 1));
  CHECK(nan.failure == "v is not a number at t = 0 s");
  const Measured failed = measure([]() -> std::unique_ptr<Motion> { fail("it does not work"); },
                                  reference(scene(0.215), 5, 1));
  CHECK(failed.failure == "it does not work");
}
