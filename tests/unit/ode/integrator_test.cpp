// SPDX-License-Identifier: GPL-3.0-or-later
#include "ode/integrator.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <list>
#include <numbers>
#include <utility>
#include <vector>

#include "base/error.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Function = std::function<void(const double*, double*)>;

/// The longest step is not limited.
struct FunctionSystem : OdeSystem {
  FunctionSystem(Function f, Function f_y) : f_(std::move(f)), f_y_(std::move(f_y)) {}
  void derivative(const double* y, double* dydt) const override { f_(y, dydt); }
  void jacobian(const double* y, double* dfdy) const override { f_y_(y, dfdy); }

 private:
  Function f_, f_y_;
};

/// x'' = -x
const FunctionSystem pendulum(
    [](const double* y, double* dydt) {
  dydt[0] = y[1];
  dydt[1] = -y[0];
    },
    [](const double*, double* dfdy) { dfdy[0] = 0, dfdy[1] = 1, dfdy[2] = -1, dfdy[3] = 0; });

/// An integration with many steps at most.
struct Integration : Integrator {
  Integration(const OdeSystem& of, Stepper stepper, double tolerance, std::vector<double> y)
      : Integrator(of, stepper, {tolerance, tolerance, 0, std::vector<double>(y.size(), 1)}, y) {}
  bool advance(double t, const Event& event = {}, unsigned long steps = 300'000) {
    return Integrator::advance(t, steps, event);
  }
};

}  // namespace

TEST_CASE("Integrator: every stepper comes closer as the tolerance falls", "[ode]") {
  for (const Stepper stepper : steppers) {
    if (stepper == gsl_odeiv2_step_rk1imp) continue;  // first order: below
    double before = 1;
    for (const double rtol : {1e-4, 1e-6, 1e-8}) {
      Integration ode(pendulum, stepper, rtol, {1, 0});
      ode.advance(3);
      const double error = std::hypot(ode.state()[0] - std::cos(3), ode.state()[1] + std::sin(3));
      INFO("stepper " << stepper->name << " rtol " << rtol << " error " << error);
      CHECK(ode.time() == 3);
      CHECK(error < 3e3 * rtol);
      CHECK(error < before);
      before = std::max(error / 5, 1e-11);
    }
  }
  Integration first_order(pendulum, gsl_odeiv2_step_rk1imp, 1e-7, {1, 0});
  first_order.advance(1);
  CHECK(std::abs(first_order.state()[0] - std::cos(1)) < 1e-3);
}

TEST_CASE("Integrator: the given times are met one after the other, the past does nothing",
          "[ode]") {
  Integration ode(pendulum, gsl_odeiv2_step_rk8pd, 1e-12, {1, 0});
  for (int i = 1; i <= 100; ++i) {
    ode.advance(0.1 * i);
    CHECK(ode.time() == 0.1 * i);
    CHECK(std::abs(ode.state()[0] - std::cos(0.1 * i)) < 1e-10);
  }
  const auto evaluations = ode.evaluations();
  CHECK(evaluations > 100);
  ode.advance(5);
  CHECK(ode.time() == 0.1 * 100);
  CHECK(ode.evaluations() == evaluations);
}

TEST_CASE("Integrator: events are located to rounding, by every stepper", "[ode]") {
  for (const Stepper stepper : steppers) {
    if (stepper == gsl_odeiv2_step_rk1imp) continue;
    Integration ode(pendulum, stepper, 1e-9, {0, 1});  // x = sin t
    const auto x = [](const std::vector<double>& y) { return y[0]; };
    for (int n = 1; n <= 3; ++n) {
      INFO("stepper " << stepper->name << " zero " << n);
      REQUIRE(ode.advance(infinity, x));
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
    Integration ode(pendulum, gsl_odeiv2_step_rk8pd, 1e-9, {-1, 0});  // x = -cos t
    REQUIRE(
        ode.advance(3, [&](const std::vector<double>& y) { return std::exp(bend * y[0]) - 1; }));
    CHECK(std::abs(ode.state()[0]) < 1e-14);
    CHECK(ode.evaluations() < 2000);
  }
}

TEST_CASE("Integrator: a stiff system needs few evaluations of an implicit stepper", "[ode]") {
  // y[0] follows y[1], which decays.
  const FunctionSystem stiff(
      [](const double* y, double* dydt) {
    dydt[0] = -1e6 * (y[0] - y[1]);
    dydt[1] = -y[1];
      },
      [](const double*, double* dfdy) {
    dfdy[0] = -1e6, dfdy[1] = 1e6, dfdy[2] = 0, dfdy[3] = -1;
  });
  for (const Stepper stepper :
       {gsl_odeiv2_step_bsimp, gsl_odeiv2_step_msbdf, gsl_odeiv2_step_rk4imp}) {
    Integration ode(stiff, stepper, 1e-8, {1, 1});
    ode.advance(1);
    CHECK(std::abs(ode.state()[0] - std::exp(-1)) < 2e-6);
    CHECK(ode.evaluations() < 20000);
  }
}

TEST_CASE("Integrator: trouble becomes an Error", "[ode]") {
  // y = (x, time), explicit
  std::list<FunctionSystem> systems;
  const auto integration = [&](auto f) {
    systems.emplace_back(
        [f](const double* y, double* dydt) {
      dydt[0] = f(y[1], y[0]);
      dydt[1] = 1;
        },
        nullptr);
    return Integration(systems.back(), gsl_odeiv2_step_rk8pd, 1e-10, {1, 0});
  };
  // y' = y^2 is infinite at t = 1
  Integration infinite = integration([](double, double y) { return y * y; });
  CHECK_THROWS_AS(infinite.advance(2), Error);
  Integration no_number =
      integration([](double t, double) { return t > 0.5 ? std::nan("") : 1.0; });
  CHECK_THROWS_AS(no_number.advance(2), Error);
  Integration long_way = integration([](double t, double) { return std::sin(1000 * t); });
  CHECK_THROWS_AS(long_way.advance(10, {}, 50), Error);
  Integration late = integration([](double, double) { return 1; });
  late.restart(1e17, {1, 0});  // doubles 16 s apart
  CHECK_THROWS_AS(late.advance(1e17 + 1000), Error);
}
