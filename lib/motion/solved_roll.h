// SPDX-License-Identifier: GPL-3.0-or-later
// The rolls that are solutions of differential equations: under any law D(v), as the independent
// reference for the closed forms and the integrals over speed, and over a bulge with memory, where
// neither exists.
#pragma once

#include <optional>
#include <vector>

#include "contact/contact.h"
#include "motion/scene.h"
#include "ode/integrator.h"

namespace rolling {

/// The state vector begins with x and v; further elements belong to the derived class. At rest v
/// and D are 0. There are two courses of the same equations: seek() advances one of them; a second
/// one determines the time of the stop when it is requested, because seek() only goes forward.
/// seek() and stop_time() throw the errors of Integrator, also after more than most_steps steps.
class SolvedRoll : public Motion, protected OdeSystem {
 public:
  SolvedRoll(const SolvedRoll&) = delete;  // the courses refer to it
  SolvedRoll& operator=(const SolvedRoll&) = delete;
  double stop_time() override;
  void seek(double t) override;
  double position() override { return course_->ode.state()[0]; }
  double velocity() override { return at_rest_ ? 0 : course_->ode.state()[1]; }
  double acceleration() override;
  unsigned long evaluations() const override { return course_->ode.evaluations(); }

 protected:
  struct Course {
    Integrator ode;
    double creep = 0;  // of the derived class
  };

  /// A part of it, times a tolerance, is still a number with all digits.
  static constexpr double least_speed = 1e-280;
  /// Throws Error for a v0 that is positive and below least_speed.
  SolvedRoll(const Scene&, Stepper, unsigned long most_steps);
  /// The constructor ends with it: the tolerance of a step, and the state at t = 0.
  void begin(Tolerance, std::vector<double> y);
  /// Integrates to t, or to the rest or the turning point if it is earlier: then it returns true.
  virtual bool advance(Course&, double t, unsigned long steps) = 0;

  Body body_;
  Incline incline_;
  double v0_;
  bool at_rest_ = false, turns_ = false;
  std::optional<double> stop_time_;  // 0 and infinity are known from the beginning
  std::optional<Course> course_;     // that seek() advances

 private:
  Course from_start() const { return {Integrator(*this, stepper_, tolerance_, first_)}; }

  Stepper stepper_;
  unsigned long most_steps_;
  Tolerance tolerance_{};
  std::vector<double> first_;
};

/// The roll under any law D(v).
///
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
  double floored(double v) const;  // D
  void derivative(const double* y, double* dydt) const override;
  void jacobian(const double* y, double* dfdy) const override;
  double longest_step(const double* y) const override;
  bool advance(Course&, double t, unsigned long steps) override;

  Law law_;
  double floor_ = 0;     // 0: v does not fall to one
  bool creeps_ = false;  // at the floor, which counts as rest
  double way_on_;        // behind a turning point
};

/// The solver for this stiffness. With q = c D(v0), the bulge and v follow each other within the
/// time length/(v0 + damping q), and the body slows down within v0/q + damping b. If the ratio of
/// these times exceeds 3e4 the system is stiff, and the result is rk4imp; above 2e7 it is bsimp,
/// whose steps do not shrink with the length; otherwise rk8pd.
Stepper memory_stepper(const Scene&);

/// x' = v, v' = -g D / ((K + A) R) (Eq. 12), z as in Bulge; z = D(v0) at t = 0.
///
/// Rest: with c = g / ((K + A) R),  E = c z^2 / 2 + a |v|^(2+b) / ((2+b) length)  never grows
/// (while damping |v| < 4 length), so it bounds every later speed. The ringing dies out only like a
/// power of time; rest is declared at the first zero of v after the roll backwards after which E
/// keeps |v| below v0 / 1000. A strongly damped bulge creeps back without another zero of v: rest
/// is also where the bound has fallen to a thousandth of what it was at the first zero. From rest
/// on v and D are exactly 0. So the roll backwards is there for every length. For b >= 2 the shift
/// fades too fast to stop the body: stop_time() is infinite. So it is on a slope: at rest the bulge
/// would relax, and the body creeps down.
class MemoryRoll final : public SolvedRoll {
 public:
  /// Throws Error for a law that is not a v^b with b >= 0 (no finite shift at rest). `rtol` is the
  /// relative error of x, v and z that a step may have.
  MemoryRoll(const Scene&, Stepper, double rtol, unsigned long most_steps);

  double shift() override;

 private:
  double fastest(const std::vector<double>& y) const;  // the bound of |v| from this state on
  void derivative(const double* y, double* dydt) const override;
  void jacobian(const double* y, double* dfdy) const override;
  double longest_step(const double* y) const override;
  bool advance(Course&, double t, unsigned long steps) override;

  PowerLaw law_;
  Bulge bulge_;
};

}  // namespace rolling
