// The roll under any law D(v) by an adaptive solver of differential equations. It is the rival that
// the closed forms and the integrals over speed are compared with, and the method for the laws that
// have neither.
#pragma once

#include "motion/solved_roll.h"

#include <functional>
#include <limits>
#include <optional>

namespace rolling {

/// D(v) [m] for v >= 0 and, for the implicit steppers, dD/dv.
struct AnyLaw {
  std::function<double(double)> shift, slope;
  bool stops = true;  ///< whether the body comes to rest in finite time
  double rest = 0;    ///< speed that counts as rest [m/s]
  double highest = std::numeric_limits<double>::infinity();  ///< speed where the law ends [m/s]
};

/// The state is (x, v), with v' = -g D(v) / ((K + A) R) (Eq. 12) and the slope's part of gravity. A
/// step may have a relative error rtol in x and in v.
///
/// Near v = 0 the derivative of the right-hand side has no bound, and the steps of a solver become
/// ever shorter. So the solver goes to v = 1e-8 v0, which is located as an event. From there on
/// dv/dt is taken to be proportional to -v^q, with the q that it has there, and the body stops
/// v / ((1 - q) |dv/dt|) later. That time is not small where q is near 1: for b = 0.9 it is 16 % of
/// the whole roll. From the stop on v, D and dv/dt are exactly 0.
class IntegratedRoll final : public SolvedRoll {
 public:
  /// Refuses R, g, v0 and K as check_roll does. Errors of the solver come out of seek() and
  /// stop_time(): steps that run out (most_steps in one call), D beyond R, v beyond the law, v that
  /// grows where the mat slows the body (the error of a step).
  IntegratedRoll(const Body&, Geometry, AnyLaw, double v0, double x0, Stepper, double rtol,
                 unsigned long most_steps = 1'000'000);

  /// The first call integrates to the stop, apart from where seek() stands.
  double stop_time() const override;
  void seek(double t) override;
  double position() override;
  double velocity() override;
  double shift() override;

 private:
  /// The part of the way that is left to a power law.
  struct Tail {
    double begin, duration, v, q;  // from [s] on, for [s], from v
  };
  Tail tail(const Integrator&) const;
  Integrator::Event floor_event() const;
  double left() const;  // of the tail, 1 .. 0
  bool at_rest() override { return velocity() == 0; }

  AnyLaw law_;
  double floor_;            // 0: the body never stops
  double t_ = 0, fastest_;  // v may not be above it
  mutable std::optional<Tail> tail_;
};

}  // namespace rolling
