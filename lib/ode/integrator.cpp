// SPDX-License-Identifier: GPL-3.0-or-later
#include "ode/integrator.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/gsl.h"

namespace rolling {

struct Integrator::Problem {
  OdeSystem system;
  gsl_odeiv2_system gsl{};
  std::unique_ptr<gsl_odeiv2_driver, void (*)(gsl_odeiv2_driver*)> driver{nullptr,
                                                                          gsl_odeiv2_driver_free};
  unsigned long evaluations = 0;

  static int derivative(double, const double* y, double* dydt, void* self) {
    auto& p = *static_cast<Problem*>(self);
    ++p.evaluations;
    p.system.derivative(y, dydt);
    // A step to a state without a finite derivative is halved. GSL would accept it whatever its
    // error: the scale of the error is then NaN.
    const bool finite = std::all_of(dydt, dydt + p.gsl.dimension,
                                    [](double slope) { return std::isfinite(slope); });
    return finite ? GSL_SUCCESS : GSL_FAILURE;
  }

  static int jacobian(double, const double* y, double* dfdy, double* dfdt, void* self) {
    auto& p = *static_cast<Problem*>(self);
    p.system.jacobian(y, dfdy);
    std::fill_n(dfdt, p.gsl.dimension, 0.0);
    return GSL_SUCCESS;
  }
};

namespace {

const gsl_odeiv2_step_type* gsl_type(Stepper stepper) {
  const gsl_odeiv2_step_type* const types[steppers] = {
      // in the order of Stepper
      gsl_odeiv2_step_rk2,    gsl_odeiv2_step_rk4,    gsl_odeiv2_step_rkf45,
      gsl_odeiv2_step_rkck,   gsl_odeiv2_step_rk8pd,  gsl_odeiv2_step_msadams,
      gsl_odeiv2_step_rk1imp, gsl_odeiv2_step_rk2imp, gsl_odeiv2_step_rk4imp,
      gsl_odeiv2_step_bsimp,  gsl_odeiv2_step_msbdf};
  return types[static_cast<std::size_t>(stepper)];
}

}  // namespace

const char* name_of(Stepper stepper) { return gsl_type(stepper)->name; }

Integrator::Integrator(OdeSystem system, Stepper stepper, const Tolerance& tolerance,
                       std::vector<double> y)
    : problem_(std::make_shared<Problem>()), y_(std::move(y)) {
  problem_->system = std::move(system);
  std::vector<double> rate(y_.size());
  problem_->system.derivative(y_.data(), rate.data());
  for (std::size_t i = 0; i < y_.size(); ++i)
    if (const double part = 1e-3 * std::abs(y_[i] / rate[i]); part > 0) h_ = std::min(h_, part);
  problem_->gsl = {Problem::derivative, Problem::jacobian, y_.size(), problem_.get()};
  silence_gsl();
  problem_->driver = own(gsl_odeiv2_driver_alloc_scaled_new(
                             &problem_->gsl, gsl_type(stepper), h_, tolerance.of_unit, 1,
                             tolerance.of_value, tolerance.of_change, tolerance.units.data()),
                         gsl_odeiv2_driver_free);
}

unsigned long Integrator::evaluations() const { return problem_->evaluations; }

void Integrator::step(double t, unsigned long& steps) {
  if (steps == 0)
    fail(
        "the integration has reached its limit of steps at t = {:.6g} s (rk8pd or, if the problem "
        "is stiff, msbdf takes far fewer)",
        t_);
  --steps;
  const double before = t_;
  const gsl_odeiv2_driver& driver = *problem_->driver;
  h_ = std::min(h_, problem_->system.longest_step(y_.data()));
  const int status =
      gsl_odeiv2_evolve_apply(driver.e, driver.c, driver.s, &problem_->gsl, &t_, t, &h_, y_.data());
  if (status != GSL_SUCCESS || t_ == before)
    fail("the integration fails at t = {:.6g} s: no step is short enough", t_);
}

bool Integrator::advance(double t, const Event& event, unsigned long& steps) {
  double before = event(y_);
  while (t_ < t) {
    const double t_before = t_;
    std::vector<double> y_before = y_;
    step(t, steps);
    const double now = event(y_);
    if (before != 0 && (now == 0 || (before < 0) != (now < 0))) {
      if (now != 0) locate(t_before, std::move(y_before), event, steps);
      return true;
    }
    before = now;
  }
  return false;
}

/// Locates the sign change within the last step by the Illinois form of regula falsi. Each trial
/// integrates anew from the beginning of the step, so its state is as accurate as any other.
void Integrator::locate(double t_before, std::vector<double> y_before, const Event& event,
                        unsigned long& steps) {
  double lo = t_before, f_lo = event(y_before), hi = t_, f_hi = event(y_);
  const double rounding = 2 * std::numeric_limits<double>::epsilon() * std::abs(hi), h = h_;
  for (int i = 0, side = 0; i < 100 && hi - lo > rounding; ++i) {
    const double last = t_, t = std::clamp(hi - f_hi * (hi - lo) / (f_hi - f_lo), lo, hi);
    restart(t_before, y_before);
    h_ = std::min(h, t - t_before);
    while (t_ < t) step(t, steps);
    const double f = event(y_);
    if (f == 0 || std::abs(t - last) <= rounding) break;
    if ((f < 0) == (f_lo < 0)) {
      lo = t, f_lo = f;
      if (side == -1) f_hi /= 2;
      side = -1;
    } else {
      hi = t, f_hi = f;
      if (side == 1) f_lo /= 2;
      side = 1;
    }
  }
  h_ = h;
}

void Integrator::restart(double t, std::vector<double> y) {
  t_ = t, y_ = std::move(y);
  gsl_odeiv2_evolve_reset(problem_->driver->e);
  gsl_odeiv2_step_reset(problem_->driver->s);
}

}  // namespace rolling
