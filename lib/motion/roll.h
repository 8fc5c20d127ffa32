// A scene, and the methods that roll it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "ode/integrator.h"
#include "contact/body.h"
#include "motion/memory.h"
#include "motion/motion.h"
#include "contact/power_law.h"
#include "contact/table_law.h"

namespace rolling {

struct Roll {
  Body body;
  Geometry geometry;
  PowerLaw law;  ///< unless there is a table
  std::optional<TableLaw> table;
  Bulge bulge{0};  ///< of length 0: no memory
  double v0, x0;
};

/// closed: ClosedForm. exact: an integral over speed, ExactForm, SlopeRoll or TableRoll. Else the
/// stepper of a solver.
struct Method {
  enum { closed, exact, solver } kind;
  Stepper stepper = Stepper::rk8pd;
};

/// The cheapest method that is exact for the scene: closed for A = 1, exact for the exact geometry,
/// tables and slopes; with memory, that has neither, the solver that suits its stiffness; rk8pd for
/// a table that does not slow the body everywhere on its slope.
Method best_method(const Roll&);

/// Throws Error when the method does not fit the scene. For solvers: the tolerance of a step, and
/// the most steps from one seek() to the next.
std::unique_ptr<Motion> start(const Roll&, Method, double rtol,
                              unsigned long most_steps = 1'000'000);

}  // namespace rolling
