// SPDX-License-Identifier: GPL-3.0-or-later
#include "ode/integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

/// x'' = -x
const OdeSystem pendulum{[](double, const double* y, double* dydt) {
  dydt[0] = y[1];
  dydt[1] = -y[0];
                         },
                         [](double, const double*, double* dfdy, double* dfdt) {
  dfdy[0] = 0, dfdy[1] = 1, dfdy[2] = -1, dfdy[3] = 0;
  dfdt[0] = dfdt[1] = 0;
}};

OdeOptions with(Stepper stepper, double rtol) {
  OdeOptions options;
  options.stepper = stepper;
  options.rtol = rtol;
  options.atol = rtol;
  return options;
}

const Integrator::Event never = [](const std::vector<double>&) { return 1.0; };

const auto all_steppers = {Stepper::rk2,    Stepper::rk4,     Stepper::rkf45,  Stepper::rkck,
                           Stepper::rk8pd,  Stepper::msadams, Stepper::rk1imp, Stepper::rk2imp,
                           Stepper::rk4imp, Stepper::bsimp,   Stepper::msbdf};

}  // namespace

TEST_CASE("Integrator: every stepper comes closer as the tolerance falls", "[ode]") {
  for (const Stepper stepper : all_steppers) {
    if (stepper == Stepper::rk1imp) continue;  // first order: below
    double before = 1;
    for (const double rtol : {1e-4, 1e-6, 1e-8}) {
      Integrator ode(pendulum, with(stepper, rtol), 0, {1, 0});
      ode.advance(3, never);
      const double error = std::hypot(ode.state()[0] - std::cos(3), ode.state()[1] + std::sin(3));
      INFO("stepper " << static_cast<int>(stepper) << " rtol " << rtol << " error " << error);
      CHECK(ode.time() == 3);
      CHECK(error < 3e3 * rtol);
      CHECK(error < before);
      before = std::max(error / 5, 1e-11);
    }
  }
  Integrator first_order(pendulum, with(Stepper::rk1imp, 1e-7), 0, {1, 0});
  first_order.advance(1, never);
  CHECK(std::abs(first_order.state()[0] - std::cos(1)) < 1e-3);
}

TEST_CASE("Integrator: the given times are met one after the other, the past does nothing",
          "[ode]") {
  Integrator ode(pendulum, with(Stepper::rk8pd, 1e-12), 0, {1, 0});
  for (int i = 1; i <= 100; ++i) {
    ode.advance(0.1 * i, never);
    CHECK(ode.time() == 0.1 * i);
    CHECK(std::abs(ode.state()[0] - std::cos(0.1 * i)) < 1e-10);
  }
  const auto evaluations = ode.evaluations();
  CHECK(evaluations > 100);
  ode.advance(5, never);
  CHECK(ode.time() == 0.1 * 100);
  CHECK(ode.evaluations() == evaluations);
}

TEST_CASE("Integrator: events are located to rounding, by every stepper", "[ode]") {
  for (const Stepper stepper : all_steppers) {
    if (stepper == Stepper::rk1imp) continue;
    Integrator ode(pendulum, with(stepper, 1e-9), 0, {0, 1});  // x = sin t
    const auto x = [](const std::vector<double>& y) { return y[0]; };
    for (int n = 1; n <= 3; ++n) {
      INFO("stepper " << static_cast<int>(stepper) << " zero " << n);
      REQUIRE(ode.advance(std::numeric_limits<double>::infinity(), x));
      CHECK(std::abs(ode.time() - n * std::numbers::pi) < 1e-5);
      CHECK(std::abs(ode.state()[0]) < 1e-14);
      ode.restart(ode.time(), {0, ode.state()[1]});
    }
    CHECK_FALSE(ode.advance(10.5, x));
    CHECK(ode.time() == 10.5);
  }
}

TEST_CASE("Integrator: an event that is far from a line", "[ode]") {
  for (const double bend : {40, -40}) {
    Integrator ode(pendulum, with(Stepper::rk8pd, 1e-9), 0, {-1, 0});  // x = -cos t
    REQUIRE(
        ode.advance(3, [&](const std::vector<double>& y) { return std::exp(bend * y[0]) - 1; }));
    CHECK(std::abs(ode.state()[0]) < 1e-14);
    CHECK(ode.evaluations() < 2000);
  }
}

TEST_CASE("Integrator: a stiff system needs few evaluations of an implicit stepper", "[ode]") {
  const OdeSystem stiff{[](double t, const double* y, double* dydt) {
    dydt[0] = -1e6 * (y[0] - std::cos(t)) - std::sin(t);
                        },
                        [](double t, const double*, double* dfdy, double* dfdt) {
    dfdy[0] = -1e6;
    dfdt[0] = -1e6 * std::sin(t) - std::cos(t);
  }};
  for (const Stepper stepper : {Stepper::bsimp, Stepper::msbdf, Stepper::rk4imp}) {
    Integrator ode(stiff, with(stepper, 1e-8), 0, {1});
    ode.advance(1, never);
    CHECK(std::abs(ode.state()[0] - std::cos(1)) < 2e-6);
    CHECK(ode.evaluations() < 20000);
  }
}

TEST_CASE("Integrator: trouble becomes an Error", "[ode]") {
  const auto system = [](auto f) {
    return OdeSystem{[f](double t, const double* y, double* dydt) { dydt[0] = f(t, y[0]); }};
  };
  // y' = y^2 is infinite at t = 1
  Integrator infinite(system([](double, double y) { return y * y; }), {}, 0, {1});
  CHECK_THROWS_AS(infinite.advance(2, never), Error);
  Integrator no_number(system([](double t, double) { return t > 0.5 ? std::nan("") : 1.0; }), {}, 0,
                       {1});
  CHECK_THROWS_AS(no_number.advance(2, never), Error);
  OdeOptions few;
  few.max_steps = 50;
  Integrator long_way(system([](double t, double) { return std::sin(1000 * t); }), few, 0, {1});
  CHECK_THROWS_AS(long_way.advance(10, never), Error);
  Integrator refuses(system([](double t, double) {
                       return t > 0.5 ? throw std::domain_error("beyond 0.5") : 1.0;
                     }),
                     {}, 0, {1});
  CHECK_THROWS_AS(refuses.advance(2, never), std::domain_error);
  Integrator late(system([](double, double) { return 1; }), {}, 1e17, {1});  // doubles 16 s apart
  CHECK_THROWS_AS(late.advance(1e17 + 1000, never), Error);
}

TEST_CASE("Integrator: wrong arguments are refused", "[ode]") {
  for (const double rtol : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    CHECK_THROWS_AS(Integrator(pendulum, with(Stepper::rkf45, rtol), 0, {1, 0}), Error);
  CHECK_THROWS_AS(Integrator(pendulum, with(Stepper::rkf45, 0), 0, {1, 0}), Error);
  CHECK_THROWS_AS(Integrator({pendulum.derivative}, with(Stepper::msbdf, 1e-6), 0, {1, 0}), Error);
  OdeOptions one_unit;
  one_unit.units = {1};
  CHECK_THROWS_AS(Integrator(pendulum, one_unit, 0, {1, 0}), Error);
  CHECK_NOTHROW(Integrator({pendulum.derivative}, with(Stepper::msadams, 1e-6), 0, {1, 0}));
}
