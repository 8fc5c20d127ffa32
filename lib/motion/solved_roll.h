// SPDX-License-Identifier: GPL-3.0-or-later
// The common part of the rolls that are solutions of differential equations.
#pragma once

#include <utility>
#include <vector>

#include "base/error.h"
#include "contact/contact.h"
#include "motion/motion.h"
#include "ode/integrator.h"

namespace rolling {

/// The state vector begins with x and v; further elements belong to the derived class. At rest v
/// and D are 0. There are two integrations of the same equations: seek() advances one of them; a
/// second one determines the time of the stop when it is requested, because seek() only goes
/// forward.
class SolvedRoll : public Motion {
 public:
  double acceleration() override {
    const double D = shift();
    return D == 0 && velocity() == 0 ? 0 : acceleration_from_shift(body_, geometry_, D);
  }
  unsigned long evaluations() const override { return ode_.evaluations(); }

 protected:
  /// A part of it, times a tolerance, is still a number with all digits.
  static constexpr double least_speed = 1e-280;
  /// `start` is the state at t = 0. Throws Error if its v is positive and below least_speed, and
  /// the errors of Integrator.
  SolvedRoll(const Body& body, Geometry geometry, OdeSystem equations, const OdeOptions& options,
             std::vector<double> start)
      : body_(body), geometry_(geometry), equations_(std::move(equations)), options_(options),
        start_(std::move(start)), ode_(equations_, options_, 0, start_) {
    if (v0() > 0 && v0() < least_speed)
      fail("the initial velocity v0 = {} is too small for a solver: the least is {:g} m/s", v0(),
           least_speed);
  }
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
