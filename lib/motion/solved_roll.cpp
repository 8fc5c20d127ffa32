// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/solved_roll.h"

#include <algorithm>

namespace rolling {

double SolvedRoll::stop_time() {
  if (!stop_time_) {
    Course course{from_start_()};
    advance(course, infinity, most_steps_);
    stop_time_ = course.ode.time();
  }
  return *stop_time_;
}

void SolvedRoll::seek(double t) {
  if (at_rest_) return;
  // The first value that stop_time() has returned remains valid: within the error of the solver it
  // depends on the steps.
  const double end = turns_ ? infinity : stop_time_.value_or(infinity);
  const bool stops = advance(course_, std::min(t, end), most_steps_);
  at_rest_ = !turns_ && (stops || t >= end);
  if (!stops) return;
  if (!stop_time_) stop_time_ = course_.ode.time();
  if (turns_) advance(course_, t, most_steps_);
}

}  // namespace rolling
