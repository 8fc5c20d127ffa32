// What the rolls have in common that are solved as differential equations.
#pragma once

#include "base/error.h"
#include "contact/contact.h"
#include "motion/motion.h"
#include "ode/integrator.h"

#include <cmath>
#include <utility>
#include <vector>

namespace rolling {

/// The state begins with x and v; what else is in it, and when the body rests, is up to the roll.
/// Two integrations run through the same equations: one goes with seek(), another is begun when the
/// time of the stop is asked for, since seek() goes forward only.
class SolvedRoll : public Motion {
 public:
  double acceleration() override {
    return at_rest() ? 0 : acceleration_from_shift(body_, geometry_, shift());
  }
  unsigned long evaluations() const override { return ode_.evaluations(); }

 protected:
  /// `start` is the state at t = 0. Throws Error unless its x is finite, and what Integrator
  /// throws.
  SolvedRoll(const Body& body, Geometry geometry, OdeSystem equations, const OdeOptions& options,
             std::vector<double> start)
      : body_(body), geometry_(geometry), equations_(std::move(equations)), options_(options),
        start_(std::move(start)), ode_(equations_, options_, 0, start_) {
    if (!std::isfinite(start_[0])) fail("the initial position x0 = {} must be finite", start_[0]);
  }
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
  Integrator ode_;  // of seek()
};

}  // namespace rolling
