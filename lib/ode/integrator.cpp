// SPDX-License-Identifier: GPL-3.0-or-later
#include "ode/integrator.h"

#include <gsl/gsl_errno.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/gsl.h"

namespace rolling {

Integrator::Integrator(const OdeSystem& system, Stepper stepper, const Tolerance& tolerance,
                       std::vector<double> y)
    : calls_(new Calls{system}), driver_(nullptr, gsl_odeiv2_driver_free), y_(std::move(y)) {
  std::vector<double> rate(y_.size());
  system.derivative(y_.data(), rate.data());
  for (std::size_t i = 0; i < y_.size(); ++i)
    if (const double part = 1e-3 * std::abs(y_[i] / rate[i]); part > 0) h_ = std::min(h_, part);
  const auto derivative = [](double, const double* at, double* dydt, void* self) {
    Calls& calls = *static_cast<Calls*>(self);
    ++calls.derivatives;
    calls.system.derivative(at, dydt);
    // A step to a state without a finite derivative is halved. GSL would accept it whatever its
    // error: the scale of the error is then NaN.
    const bool finite = std::all_of(dydt, dydt + calls.gsl.dimension,
                                    [](double slope) { return std::isfinite(slope); });
    return static_cast<int>(finite ? GSL_SUCCESS : GSL_FAILURE);
  };
  const auto jacobian = [](double, const double* at, double* dfdy, double* dfdt, void* self) {
    const Calls& calls = *static_cast<Calls*>(self);
    calls.system.jacobian(at, dfdy);
    std::fill_n(dfdt, calls.gsl.dimension, 0.0);
    return static_cast<int>(GSL_SUCCESS);
  };
  calls_->gsl = {derivative, jacobian, y_.size(), calls_.get()};
  silence_gsl();
  driver_ = own(gsl_odeiv2_driver_alloc_scaled_new(&calls_->gsl, stepper, h_, tolerance.of_unit, 1,
                                                   tolerance.of_value, tolerance.of_change,
                                                   tolerance.units.data()),
                gsl_odeiv2_driver_free);
}

void Integrator::step(double t, unsigned long& steps) {
  if (steps == 0)
    fail(
        "the integration has reached its limit of steps at t = {:.6g} s (rk8pd or, if the problem "
        "is stiff, msbdf takes far fewer)",
        t_);
  --steps;
  const double before = t_;
  h_ = std::min(h_, calls_->system.longest_step(y_.data()));
  const int status = gsl_odeiv2_evolve_apply(driver_->e, driver_->c, driver_->s, &calls_->gsl, &t_,
                                             t, &h_, y_.data());
  if (status != GSL_SUCCESS || t_ == before)
    fail("the integration fails at t = {:.6g} s: no step is short enough", t_);
}

bool Integrator::advance(double t, unsigned long& steps, const Event& event) {
  if (!event) {
    while (t_ < t) step(t, steps);
    return false;
  }
  double before = event(y_);
  while (t_ < t) {
    const double t_before = t_;
    std::vector<double> y_before = y_;
    step(t, steps);
    const double now = event(y_);
    if (before != 0 && (now == 0 || (before < 0) != (now < 0))) {
      if (now != 0) locate(t_before, y_before, event, steps);
      return true;
    }
    before = now;
  }
  return false;
}

/// Locates the sign change within the last step by the Illinois form of regula falsi. Each trial
/// integrates anew from the beginning of the step, so its state is as accurate as any other.
void Integrator::locate(double t_before, const std::vector<double>& y_before, const Event& event,
                        unsigned long& steps) {
  double lo = t_before;
  double f_lo = event(y_before);
  double hi = t_;
  double f_hi = event(y_);
  const double rounding = 2 * std::numeric_limits<double>::epsilon() * std::abs(hi);
  const double h = h_;
  for (int i = 0, side = 0; i < 100 && hi - lo > rounding; ++i) {
    const double last = t_;
    const double t = std::clamp(hi - f_hi * (hi - lo) / (f_hi - f_lo), lo, hi);
    restart(t_before, y_before);
    h_ = std::min(h, t - t_before);
    while (t_ < t) step(t, steps);
    const double f = event(y_);
    if (f == 0 || std::abs(t - last) <= rounding) break;
    if ((f < 0) == (f_lo < 0)) {
      lo = t;
      f_lo = f;
      if (side == -1) f_hi /= 2;
      side = -1;
    } else {
      hi = t;
      f_hi = f;
      if (side == 1) f_lo /= 2;
      side = 1;
    }
  }
  h_ = h;
}

void Integrator::restart(double t, std::vector<double> y) {
  t_ = t;
  y_ = std::move(y);
  gsl_odeiv2_evolve_reset(driver_->e);
  gsl_odeiv2_step_reset(driver_->s);
}

}  // namespace rolling
