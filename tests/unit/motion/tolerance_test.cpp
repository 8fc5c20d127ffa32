// SPDX-License-Identifier: GPL-3.0-or-later
// What a tolerance of a solver promises.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "motion/scene.h"
#include "unit/catch.h"
#include "unit/many.h"

using namespace rolling;

namespace {

struct Worst {
  double speed = 0, stop = 0;  // as a part of v0, and of the stop
};

/// The largest errors of v at a few times up to beyond the stop, and that of the stop. Many rows
/// would limit the steps, which a solver chooses freely between them.
Worst errors(const Scene& roll, Stepper stepper, double rtol) {
  const auto exact = start(roll, best_method(roll), 0),
             solver = start(roll, {Method::solver, stepper}, rtol, 100'000);
  const double stop = exact->stop_time(), end = std::isfinite(stop) ? 1.4 * stop : 5;
  Worst worst;
  constexpr int n = 3;
  for (int i = 1; i <= n; ++i) {
    exact->seek(end * i / n), solver->seek(end * i / n);
    const double error = std::abs(solver->velocity() - exact->velocity()) / roll.v0;
    worst.speed = error <= worst.speed ? worst.speed : error;  // not a number is worst
  }
  if (std::isfinite(stop)) worst.stop = std::abs(solver->stop_time() / stop - 1);
  return worst;
}

}  // namespace

TEST_CASE("Solvers: v and the stop are within 100 tolerances, or the roll is refused",
          "[rolling]") {
  const Scene scenes[] = {{{1.375, 0.04, 0.5}, PowerLaw{5.75e-4, 0.0244}, {0}, 0.5, 0},
                          {{1.375, 0.04, 0.5}, PowerLaw{1.87e-3, 0.215}, {0}, 0.5, 0},
                          {{1.375, 0.04, 0.83}, PowerLaw{5.75e-4, 0.0244}, {0}, 0.5, 0},
                          {{1.375, 0.04, 0.83}, PowerLaw{1.78e-3, 0.255}, {0}, 0.5, 0}};
  InTurn in_turn;
  for (const Stepper stepper : steppers)
    for (const double rtol : {1e-12, 1e-11, 1e-10, 1e-8, 1e-6, 1e-4, 1e-3, 3e-3, 1e-2, 0.1}) {
      // Steps of the first order are as many as 1/rtol.
      if (stepper == gsl_odeiv2_step_rk1imp && rtol < 1e-4) continue;
      std::string refused;
      for (Scene roll : scenes)
        for (const bool is_exact : {false, true})
          for (const double slope : {0.0, 0.001, -0.001, 0.02, 0.1}) {
            if (!refused.empty() || !in_turn()) continue;
            roll.body.exact = is_exact, roll.body.slope = slope;
            INFO("stepper " << stepper->name << " rtol " << rtol << " law " << roll.law(1) << " K "
                            << roll.body.K << " slope " << slope << " exact " << is_exact);
            try {
              const Worst worst = errors(roll, stepper, rtol);
              CHECK(worst.speed <= 100 * rtol);
              CHECK(worst.stop <= 100 * rtol);
            } catch (const Error& error) {
              refused = error.what();
            }
          }
      INFO("stepper " << stepper->name << " rtol " << rtol << ": " << refused);
      const double least = stepper == gsl_odeiv2_step_rk1imp ? 1e-3
                           : stepper == gsl_odeiv2_step_rk2 || stepper == gsl_odeiv2_step_rk2imp
                               ? 1e-8
                               : 0;
      CHECK((refused.empty() || rtol < least));
      CHECK((refused.empty() || refused.find("(rk8pd") != std::string::npos));
    }
}
