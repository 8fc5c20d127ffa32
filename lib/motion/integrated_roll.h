// SPDX-License-Identifier: GPL-3.0-or-later
// The roll under any law D(v), by an adaptive solver of differential equations. It is the
// independent reference for the closed forms and the integrals over speed, and the method for laws
// that have neither.
#pragma once

#include "contact/law.h"
#include "motion/solved_roll.h"

#include <optional>

namespace rolling {

/// Solves for the state (x, v) with v' = -g D(v) / ((K + A) R) (Eq. 12) and, on a slope, the
/// component of gravity. rtol is the error of x and v that a step may have, relative to their
/// change in it, so that the sum is a part of the way and of v0, however many steps there are.
///
/// At v = 0 the derivative of the right-hand side is unbounded, and the steps of a solver become
/// ever shorter. None is longer than half of v/|v'|: none passes over the stop, where an estimate
/// of the error would mean nothing. The solver ends at v = 1e-10 v0 (for b < 0 where 1e-10 of the
/// time is left), located as an event. From there on dv/dt is assumed proportional to -v^q, with
/// the local exponent q, so that the body stops v / ((1 - q) |dv/dt|) later. That time is not small
/// if q is near 1: for b = 0.9 it is 10 % of the whole roll. From the stop on v, D and dv/dt are
/// exactly 0.
class IntegratedRoll final : public SolvedRoll {
 public:
  /// For what check_roll accepts. `rest` is the speed that counts as rest [m/s]; none for a body
  /// that rolls for ever. seek() and stop_time() throw the errors of the solver: more than
  /// most_steps steps in one call, D above R, and v above the range of the law.
  IntegratedRoll(const Body&, Geometry, Law, std::optional<double> rest, double v0, double x0,
                 Stepper, double rtol, unsigned long most_steps = 1'000'000);

  /// The first call integrates to the stop, independently of seek().
  double stop_time() override;
  void seek(double t) override;
  double position() override;
  double velocity() override;
  double shift() override;

 private:
  /// The last part of the roll, under a power law of dv/dt.
  struct Tail {
    double begin, duration, v, q;  // begin and duration [s], speed at begin, exponent
  };
  Tail tail(const Integrator&) const;
  Integrator::Event floor_event() const;
  double left() const;  // remaining fraction of the tail, 1 to 0

  Law law_;
  std::optional<double> rest_;
  double floor_;  // 0: the body never stops
  double t_ = 0;
  std::optional<Tail> tail_;
};

}  // namespace rolling
