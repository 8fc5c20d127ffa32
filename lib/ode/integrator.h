// SPDX-License-Identifier: GPL-3.0-or-later
// Autonomous differential equations y' = f(y) by the adaptive steppers of GSL: forward in time, to
// given times or to an event.
#pragma once

#include <gsl/gsl_odeiv2.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

namespace rolling {

/// The equations. Their functions are called through C code: they do not throw.
class OdeSystem {
 public:
  virtual ~OdeSystem() = default;
  virtual void derivative(const double* y, double* dydt) const = 0;
  /// df/dy row by row, for the implicit steppers.
  virtual void jacobian(const double* /*y*/, double* /*dfdy*/) const {}
  /// Of a step from the state y.
  virtual double longest_step(const double* /*y*/) const { return INFINITY; }
};

using Stepper = const gsl_odeiv2_step_type*;
inline const std::array<Stepper, 11> steppers{
    gsl_odeiv2_step_rk2,    gsl_odeiv2_step_rk4,     gsl_odeiv2_step_rkf45,  gsl_odeiv2_step_rkck,
    gsl_odeiv2_step_rk8pd,  gsl_odeiv2_step_msadams, gsl_odeiv2_step_rk1imp, gsl_odeiv2_step_rk2imp,
    gsl_odeiv2_step_rk4imp, gsl_odeiv2_step_bsimp,   gsl_odeiv2_step_msbdf};

/// The error that a step may have: relative to y, plus in these units of y, plus relative to the
/// change of y in the step.
struct Tolerance {
  double of_value, of_unit, of_change;
  std::vector<double> units;  ///< one for each element of y
};

class Integrator {
 public:
  /// A function of the state whose zero is the event.
  using Event = std::function<double(const std::vector<double>&)>;

  /// From the state y at t = 0. The system must exist as long as this object.
  Integrator(const OdeSystem&, Stepper, const Tolerance&, std::vector<double> y);

  double time() const { return t_; }
  const std::vector<double>& state() const { return y_; }
  unsigned long evaluations() const { return calls_->derivatives; }  ///< so far

  /// Integrates to exactly t; does nothing if t is not after time(). Stops at the first sign change
  /// of the event (located to rounding) and then returns true. t may be infinite. Subtracts its
  /// steps from `steps`. Throws Error if none is left, or if GSL fails.
  bool advance(double t, unsigned long& steps, const Event& = {});
  /// Continues from another time and state: at a kink of the derivative, restart on its other side.
  void restart(double t, std::vector<double> y);

 private:
  /// What GSL calls. It has pointers to this.
  struct Calls {
    const OdeSystem& system;
    gsl_odeiv2_system gsl{};
    unsigned long derivatives = 0;
  };
  void step(double t, unsigned long& steps);
  void locate(double t_before, const std::vector<double>& y_before, const Event&,
              unsigned long& steps);

  std::unique_ptr<Calls> calls_;
  std::unique_ptr<gsl_odeiv2_driver, void (*)(gsl_odeiv2_driver*)> driver_;
  double t_ = 0;
  std::vector<double> y_;
  // A first guess, or less where the state changes faster; the error control corrects it.
  double h_ = 1e-6;
};

}  // namespace rolling
