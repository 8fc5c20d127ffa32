// The roll under any law D(v) by an adaptive solver of differential equations: what it costs to do without an integral over speed.
#pragma once

#include "ode/integrator.h"
#include "rolling/body.h"
#include "rolling/motion.h"

#include <functional>
#include <optional>

namespace rolling {

/// D(v) [m] for v >= 0 and, for the implicit steppers, dD/dv; whether the body comes to rest in finite time.
struct AnyLaw {
  std::function<double(double)> shift, slope;
  bool stops = true;
};

/// y = (x, v), v' = -g D(v) / ((K + A) R) (Eq. 12). The tolerance is rtol of x and v in each step, plus 1e-3 rtol of v0.
/// The stop is where v falls to the latter (about v = 0 the right-hand side has no bounded derivative, and solvers chatter), located as an
/// event; from there on v, D and dv/dt are exactly 0.
class IntegratedRoll final : public Motion {
 public:
  /// Refuses R, g, v0 and K as check_roll does. Errors of the solver come out of seek() and stop_time(): steps that run out (1e6 between
  /// two calls), D beyond R.
  IntegratedRoll(const Body&, Geometry, AnyLaw, double v0, double x0, Stepper, double rtol);

  /// The first call integrates to the stop, apart from where seek() stands.
  double stop_time() const override;
  void seek(double t) override;
  double position() override { return ode_.state()[0]; }
  double velocity() override { return at_rest_ ? 0 : ode_.state()[1]; }
  double acceleration() override;
  double shift() override;
  unsigned long evaluations() const override { return ode_.evaluations(); }

 private:
  double floor() const { return law_.stops ? options_.atol : 0; }
  Integrator start() const;
  Integrator::Event stop_event() const;

  Body body_;
  Geometry geometry_;
  AnyLaw law_;
  double v0_, x0_;
  OdeOptions options_;
  Integrator ode_;
  bool at_rest_;
  mutable std::optional<double> stop_time_;
};

}  // namespace rolling
