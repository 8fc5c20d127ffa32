#include "motion/roll.h"

#include <cmath>

#include "base/error.h"
#include "contact/contact.h"
#include "motion/closed_form.h"
#include "motion/exact_form.h"
#include "motion/integrated_roll.h"
#include "motion/slope_roll.h"
#include "motion/table_roll.h"
#include "motion/trajectory.h"

namespace rolling {

namespace {

AnyLaw any_law(const Roll& roll) {
  if (roll.table)
    return {*roll.table, [table = *roll.table](double v) { return table.slope(v); },
            always_slows(roll.body, roll.geometry, *roll.table, roll.v0), 0, roll.table->highest()};
  const auto slope = [law = roll.law](double v) { return law.b * law(v) / v; };
  if (roll.body.slope == 0) {
    check_roll(roll.body, roll.law, roll.v0);
    return {roll.law, slope, roll.law.b < 1};
  }
  const Trajectory trajectory(roll.body, roll.geometry, roll.law, roll.v0);
  return {roll.law, slope, std::isfinite(trajectory.stop_time()), trajectory.rest_speed()};
}

/// Throws Error if a body at rest on a slope would begin to roll: it stays only if the shift at
/// rest balances gravity.
void check_rest(const Roll& roll) {
  const auto& [body, geometry, law, table, bulge, v0, x0] = roll;
  if (v0 != 0 || body.slope == 0 || (!table && bulge.length == 0 && law.b < 0)) return;
  const double D = bulge.length > 0 ? 0 : table ? (*table)(0) : law.b == 0 ? law.a : 0;
  const auto [cos, sin] = incline(body);
  if (D * cos >= arm_factor(body, geometry, D) * body.R * std::abs(sin)) return;
  fail(
      "v0 = 0: on a slope of {} the body begins to roll {}, for at rest the law holds it by D = "
      "{:.3g} m alone: {}",
      body.slope, body.slope < 0 ? "down" : "back", D,
      body.slope < 0 ? "say a small v0, as 1e-9"
                     : "turn the sign of the slope, and say a small v0, as 1e-9");
}

}  // namespace

Method best_method(const Roll& roll) {
  if (roll.bulge.length > 0)
    return {Method::solver, memory_stepper(roll.body, roll.law, roll.bulge, roll.v0)};
  if (roll.table)
    return {always_slows(roll.body, roll.geometry, *roll.table, roll.v0) ? Method::exact
                                                                         : Method::solver};
  return {roll.geometry == Geometry::exact || roll.body.slope != 0 ? Method::exact
                                                                   : Method::closed};
}

std::unique_ptr<Motion> start(const Roll& roll, Method method, double rtol,
                              unsigned long most_steps) {
  const auto& [body, geometry, law, table, bulge, v0, x0] = roll;
  if (!std::isfinite(x0)) fail("the initial position x0 = {} must be finite", x0);
  check_rest(roll);
  if (bulge.length > 0) {
    if (table) fail("the memory goes with a law a v^b, not with a table");
    if (method.kind != Method::solver)
      fail(
          "a bulge with memory has no closed form and no integral over speed: its methods are the "
          "solvers");
    return std::make_unique<MemoryRoll>(body, geometry, law, bulge, v0, x0, method.stepper, rtol,
                                        most_steps);
  }
  if (method.kind == Method::closed) {
    if (table) fail("the method closed goes with a law a v^b: a table has no closed form");
    if (geometry == Geometry::exact)
      fail("the method closed goes with A = 1: the exact geometry has no closed form");
    if (body.slope != 0)
      fail("the method closed goes with a level mat: on a slope there is no closed form");
    return std::make_unique<ClosedForm>(body, law, v0, x0);
  }
  if (method.kind == Method::exact) {
    if (table) return std::make_unique<TableRoll>(body, geometry, *table, v0, x0);
    if (body.slope != 0) return std::make_unique<SlopeRoll>(body, geometry, law, v0, x0);
    if (geometry == Geometry::approximate)
      fail(
          "the method exact goes with the exact geometry, a table or a slope: for A = 1 there is "
          "closed");
    return std::make_unique<ExactForm>(body, law, v0, x0);
  }
  if (table && v0 > table->highest())
    fail("the initial velocity v0 = {} is above the table of the law, which ends at {}", v0,
         table->highest());
  return std::make_unique<IntegratedRoll>(body, geometry, any_law(roll), v0, x0, method.stepper,
                                          rtol, most_steps);
}

}  // namespace rolling
