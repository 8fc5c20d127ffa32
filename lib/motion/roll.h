// A scene and the methods that compute its motion.
#pragma once

#include <memory>
#include <optional>

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
  PowerLaw law;  ///< used if there is no table
  std::optional<TableLaw> table;
  Bulge bulge{0};  ///< of length 0: no memory
  double v0, x0;
};

/// closed: ClosedForm. exact: an integral over speed, by ExactForm, SlopeRoll or TableRoll. solver:
/// a differential equation, by this stepper.
struct Method {
  enum { closed, exact, solver } kind;
  Stepper stepper = Stepper::rk8pd;
};

/// The fastest method that is exact for the scene: closed for A = 1; exact for the exact geometry,
/// tables and slopes; with memory, where neither exists, the solver that suits the stiffness; rk8pd
/// for a table under which the body does not slow down at every speed on its slope.
Method best_method(const Roll&);

/// Constructs the motion at t = 0. rtol and most_steps concern solvers: the tolerance of a step,
/// and the largest number of steps from one seek() to the next. Throws Error if x0 is not finite,
/// and if the method does not suit the scene.
std::unique_ptr<Motion> start(const Roll&, Method, double rtol,
                              unsigned long most_steps = 1'000'000);

}  // namespace rolling
