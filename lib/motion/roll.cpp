#include "motion/roll.h"

#include <cmath>

#include "base/error.h"
#include "motion/closed_form.h"
#include "motion/exact_form.h"
#include "motion/integrated_roll.h"
#include "motion/table_roll.h"
#include "motion/trajectory.h"

namespace rolling {

namespace {

AnyLaw any_law(const Roll& roll) {
  if (roll.table)
    return {*roll.table, [table = *roll.table](double v) { return table.slope(v); }, true};
  check_roll(roll.body, roll.law, roll.v0);
  return {roll.law, [law = roll.law](double v) { return law.b * law(v) / v; }, roll.law.b < 1};
}

}  // namespace

Method best_method(const Roll& roll) {
  if (roll.bulge.length > 0)
    return {Method::solver, memory_stepper(roll.body, roll.law, roll.bulge, roll.v0)};
  return {roll.table || roll.geometry == Geometry::exact ? Method::exact : Method::closed};
}

std::unique_ptr<Motion> start(const Roll& roll, Method method, double rtol) {
  const auto& [body, geometry, law, table, bulge, v0, x0] = roll;
  if (bulge.length > 0) {
    if (table) fail("the memory goes with a law a v^b, not with a table");
    if (method.kind != Method::solver)
      fail(
          "a bulge with memory has no closed form and no integral over speed: its methods are the "
          "solvers");
    OdeOptions options;
    options.stepper = method.stepper;
    options.rtol = rtol;
    options.atol = 1e-3 * rtol;
    return std::make_unique<MemoryRoll>(body, geometry, law, bulge, v0, x0, options);
  }
  if (method.kind == Method::closed) {
    if (table) fail("the method closed goes with a law a v^b: a table has no closed form");
    if (geometry == Geometry::exact)
      fail("the method closed goes with A = 1: the exact geometry has no closed form");
    return std::make_unique<ClosedForm>(body, law, v0, x0);
  }
  if (method.kind == Method::exact) {
    if (table) return std::make_unique<TableRoll>(body, geometry, *table, v0, x0);
    if (geometry == Geometry::approximate)
      fail("the method exact goes with the exact geometry or a table: for A = 1 there is closed");
    return std::make_unique<ExactForm>(body, law, v0, x0);
  }
  if (table && v0 > table->highest())
    fail("the initial velocity v0 = {} is above the table of the law, which ends at {}", v0,
         table->highest());
  return std::make_unique<IntegratedRoll>(body, geometry, any_law(roll), v0, x0, method.stepper,
                                          rtol);
}

}  // namespace rolling
