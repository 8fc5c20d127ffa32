// SPDX-License-Identifier: GPL-3.0-or-later
// GSL's steppers in the ordinary way: gsl_odeiv2_driver from sample to sample, no event. The law is
// a v^b by pow(v, b) as it is printed, or odd in v, as one writes it after the first NaN.
#pragma once

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/gsl.h"
#include "motion/scene.h"

namespace rolling {

class BareGsl final : public Motion {
 public:
  static constexpr unsigned long most_evaluations = 1'000'000;

  BareGsl(const Scene& scene, const gsl_odeiv2_step_type* type, double rtol, bool odd)
      : scene_(scene), power_(scene.law.power().value_or(PowerLaw{})),
        odd_(odd), system_{derivative, jacobian, dimension(), this} {
    silence_gsl();
    y_[0] = scene.v0, y_[1] = scene.law(scene.v0);
    driver_ = gsl_odeiv2_driver_alloc_y_new(&system_, type, 1e-6, 1e-3 * rtol, rtol);
  }
  BareGsl(const BareGsl&) = delete;
  BareGsl& operator=(const BareGsl&) = delete;
  ~BareGsl() override { gsl_odeiv2_driver_free(driver_); }

  double stop_time() override { return std::numeric_limits<double>::quiet_NaN(); }  // it has none
  void seek(double t) override {
    if (t <= t_) return;
    const int status = gsl_odeiv2_driver_apply(driver_, &t_, t, y_);
    if (evaluations_ > most_evaluations) fail("more than 1e6 evaluations, at t = {:.6g} s", t_);
    if (status != GSL_SUCCESS) fail("GSL says '{}' at t = {:.6g} s", gsl_strerror(status), t_);
  }
  double position() override { return 0; }
  double velocity() override { return y_[0]; }
  double acceleration() override { return 0; }
  double shift() override { return 0; }
  unsigned long evaluations() const override { return evaluations_; }

 private:
  std::size_t dimension() const { return scene_.bulge.length > 0 ? 2 : 1; }

  double pull(double D) const {
    const double d = D / scene_.body.R, A = scene_.body.exact ? std::sqrt(1 - d * d) : 1;
    return -scene_.body.g * d / (scene_.body.K + A);
  }
  double law(double v) const {
    if (odd_ && v <= 0) return v == 0 ? 0 : -law(-v);
    return scene_.law.has_points() ? scene_.law.at(std::max(v, 0.0)).D
                                   : power_.a * std::pow(v, power_.b);
  }

  static int derivative(double, const double* y, double* dydt, void* self) {
    auto& me = *static_cast<BareGsl*>(self);
    if (++me.evaluations_ > most_evaluations) return GSL_EBADFUNC;
    if (const double L = me.scene_.bulge.length; L > 0) {
      const double v = y[0], z = y[1];
      dydt[1] = (v * me.power_.a * std::pow(std::abs(v), me.power_.b) - std::abs(v) * z) / L;
      dydt[0] = me.pull(z + me.scene_.bulge.damping * dydt[1]);
    } else {
      dydt[0] = me.pull(me.law(y[0]));
    }
    return GSL_SUCCESS;
  }

  static int jacobian(double t, const double* y, double* dfdy, double* dfdt,
                      void* self) {  // by differences
    auto& me = *static_cast<BareGsl*>(self);
    const std::size_t n = me.dimension();
    double f0[2], f1[2], shifted[2] = {y[0], n > 1 ? y[1] : 0};
    if (derivative(t, y, f0, self) != GSL_SUCCESS) return GSL_EBADFUNC;
    for (std::size_t j = 0; j < n; ++j) {
      const double h = 1e-8 * std::max(std::abs(y[j]), 1e-6);
      shifted[j] = y[j] + h;
      if (derivative(t, shifted, f1, self) != GSL_SUCCESS) return GSL_EBADFUNC;
      shifted[j] = y[j];
      for (std::size_t i = 0; i < n; ++i) dfdy[i * n + j] = (f1[i] - f0[i]) / h;
    }
    std::fill(dfdt, dfdt + n, 0.0);
    return GSL_SUCCESS;
  }

  Scene scene_;
  PowerLaw power_;
  bool odd_;
  gsl_odeiv2_system system_;
  gsl_odeiv2_driver* driver_ = nullptr;
  double t_ = 0, y_[2] = {0, 0};
  unsigned long evaluations_ = 0;
};

}  // namespace rolling
