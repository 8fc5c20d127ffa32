// The common part of the rolls that are solutions of differential equations.
#pragma once

#include "contact/body.h"
#include "motion/motion.h"
#include "ode/integrator.h"

#include <vector>

namespace rolling {

/// The state vector begins with x and v; further elements and the condition for rest belong to the
/// derived class. There are two integrations of the same equations: seek() advances one of them; a
/// second one determines the time of the stop when it is requested, because seek() only goes
/// forward.
class SolvedRoll : public Motion {
 public:
  double acceleration() override;
  unsigned long evaluations() const override { return ode_.evaluations(); }

 protected:
  /// `start` is the state at t = 0. Throws Error if its x is not finite, and the errors of
  /// Integrator.
  SolvedRoll(const Body&, Geometry, OdeSystem, const OdeOptions&, std::vector<double> start);
  /// True if the body has come to rest: then dv/dt is exactly 0.
  virtual bool at_rest() = 0;

  Integrator from_start() const { return {equations_, options_, 0, start_}; }
  double v0() const { return start_[1]; }
  double x() const { return ode_.state()[0]; }
  double v() const { return ode_.state()[1]; }

  Body body_;
  Geometry geometry_;
  OdeSystem equations_;
  OdeOptions options_;
  std::vector<double> start_;
  Integrator ode_;  // that seek() advances
};

}  // namespace rolling
