// SPDX-License-Identifier: GPL-3.0-or-later
// The common part of the rolls that are solutions of differential equations.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "base/error.h"
#include "contact/contact.h"
#include "motion/scene.h"
#include "ode/integrator.h"

namespace rolling {

/// The state vector begins with x and v; further elements belong to the derived class. At rest v
/// and D are 0. There are two courses of the same equations: seek() advances one of them; a second
/// one determines the time of the stop when it is requested, because seek() only goes forward.
/// seek() and stop_time() throw the errors of Integrator, also after more than most_steps steps.
class SolvedRoll : public Motion {
 public:
  double stop_time() override {
    if (!stop_time_) {
      Course course{from_start_()};
      advance(course, infinity, most_steps_);
      stop_time_ = course.ode.time();
    }
    return *stop_time_;
  }
  void seek(double t) override {
    if (at_rest_) return;
    // The first value that stop_time() has returned remains valid: within the error of the solver
    // it depends on the steps.
    const double end = turns_ ? infinity : stop_time_.value_or(infinity);
    const bool stops = advance(course_, std::min(t, end), most_steps_);
    at_rest_ = !turns_ && (stops || t >= end);
    if (!stops) return;
    if (!stop_time_) stop_time_ = course_.ode.time();
    if (turns_) advance(course_, t, most_steps_);
  }
  double position() override { return course_.ode.state()[0]; }
  double velocity() override { return at_rest_ ? 0 : course_.ode.state()[1]; }
  double acceleration() override {
    const double D = shift();
    return at_rest_ ? 0 : acceleration_from_shift(body_, geometry_, D);
  }
  unsigned long evaluations() const override { return course_.ode.evaluations(); }

 protected:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  struct Course {
    Integrator ode;
    double creep = 0;  // of the derived class
  };

  /// A part of it, times a tolerance, is still a number with all digits.
  static constexpr double least_speed = 1e-280;
  /// Throws Error for a v0 that is positive and below least_speed.
  SolvedRoll(const Scene& scene, unsigned long most_steps, std::function<Integrator()> from_start)
      : body_(scene.body), geometry_(scene.geometry), v0_(scene.v0), most_steps_(most_steps),
        from_start_(std::move(from_start)), course_{from_start_()} {
    if (v0_ > 0 && v0_ < least_speed)
      fail("the initial velocity v0 = {} is too small for a solver: the least is {:g} m/s", v0_,
           least_speed);
  }
  /// Integrates to t, or to the rest or the turning point if it is earlier: then it returns true.
  virtual bool advance(Course&, double t, unsigned long steps) = 0;

  Body body_;
  Geometry geometry_;
  double v0_;
  unsigned long most_steps_;
  std::function<Integrator()> from_start_;
  bool at_rest_ = false, turns_ = false;
  std::optional<double> stop_time_;  // 0 and infinity are known from the beginning
  Course course_;                    // that seek() advances
};

}  // namespace rolling
