// SPDX-License-Identifier: GPL-3.0-or-later
// The roll under any law D(v), by an adaptive solver of differential equations. It is the
// independent reference for the closed forms and the integrals over speed, and the method for laws
// that have neither.
#pragma once

#include "motion/solved_roll.h"

namespace rolling {

/// Solves for the state (x, v) with v' = -g D(v) / ((K + A) R) (Eq. 12) and, on a slope, the
/// component of gravity. rtol is the error of x and v that a step may have, relative to their
/// change in it, so that the sum is a part of the way and of v0, however many steps there are.
///
/// At v = 0 the derivative of the right-hand side is unbounded, and the steps of a solver become
/// ever shorter. None is longer than half of |v/v'|: none passes over the stop, where an estimate
/// of the error would mean nothing. The floor, v = 1e-10 v0 (for b < 0 where 1e-10 of the time is
/// left), is located as an event. From there the body rests, with v, D and dv/dt exactly 0, or it
/// begins the way back. Below the floor dv/dt is about -v^q with the local exponent q: the stop is
/// v / ((1 - q) |dv/dt|) later: for q near 1 that is not small.
class IntegratedRoll final : public SolvedRoll {
 public:
  /// For what check_roll accepts. seek() and stop_time() throw Error, too, for D above R and v
  /// above the range of the law.
  IntegratedRoll(const Scene&, Stepper, double rtol, unsigned long most_steps);

  double shift() override;

 private:
  /// How the first part of the roll ends.
  struct End {
    double floor;  // 0: never
    bool creeps;   // at the floor, which counts as rest
    bool turns;
  };
  static End end_of(const Scene&);
  bool advance(Course&, double t, unsigned long steps) override;

  Law law_;
  End end_;
};

}  // namespace rolling
