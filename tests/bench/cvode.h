// SPDX-License-Identifier: GPL-3.0-or-later
// CVODE in the ordinary way: from sample to sample, the stop by its root finding. Where
// libsundials-dev (6 or later) is installed.
#pragma once

#if __has_include(<cvode/cvode.h>)
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#define HAVE_CVODE

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/gsl.h"
#include "motion/scene.h"
#include "contact/contact.h"

namespace rolling {

/// y = v, or (v, z) with memory; CVODE's difference quotients for the Jacobian and its dense
/// solver. The absolute tolerance is 1e-3 rtol v0, and the stop is where v falls to it; below, the
/// law goes on as a constant. (With memory there is no stop: it rings on.)
class Cvode final : public Motion {
 public:
  static constexpr unsigned long most_evaluations = 1'000'000;

  /// method: CV_ADAMS or CV_BDF.
  Cvode(const Scene& scene, int method, double rtol)
      : scene_(scene), floor_(1e-3 * rtol * scene.v0) {
    const sunindextype n = scene.bulge.length > 0 ? 2 : 1;
    y_ = own(N_VNew_Serial(n, context_.get()), N_VDestroy);
    matrix_ = own(SUNDenseMatrix(n, n, context_.get()), SUNMatDestroy);
    solver_ = own(
        SUNLinSol_Dense(y_.get(), matrix_.get(), context_.get()),
        +[](SUNLinearSolver solver) { SUNLinSolFree(solver); });
    cvode_ = own(
        CVodeCreate(method, context_.get()), +[](void* memory) { CVodeFree(&memory); });
    NV_Ith_S(y_.get(), 0) = scene.v0;
    if (n > 1) NV_Ith_S(y_.get(), 1) = scene.law(scene.v0);
    check(CVodeInit(cvode_.get(), derivative, 0, y_.get()));
    check(CVodeSStolerances(cvode_.get(), rtol, floor_));
    check(CVodeSetUserData(cvode_.get(), this));
    check(CVodeSetMaxNumSteps(cvode_.get(), static_cast<long>(most_evaluations)));
    check(CVodeSetLinearSolver(cvode_.get(), solver_.get(), matrix_.get()));
    check(CVodeSetErrFile(cvode_.get(), nullptr));
    if (n == 1) check(CVodeRootInit(cvode_.get(), 1, above_floor));
  }
  Cvode(const Cvode&) = delete;
  Cvode& operator=(const Cvode&) = delete;

  /// Of the stop that seek() has met; NaN before it.
  double stop_time() override { return stopped_ ? t_ : std::numeric_limits<double>::quiet_NaN(); }
  void seek(double t) override {
    if (stopped_ || t <= t_) return;
    const int status = CVode(cvode_.get(), t, y_.get(), &t_, CV_NORMAL);
    if (evaluations_ > most_evaluations) fail("more than 1e6 evaluations, at t = {:.6g} s", t_);
    check(status);
    stopped_ = status == CV_ROOT_RETURN;
  }
  double position() override { return 0; }
  double velocity() override { return stopped_ ? 0 : NV_Ith_S(y_.get(), 0); }
  double acceleration() override { return 0; }
  double shift() override { return 0; }
  unsigned long evaluations() const override { return evaluations_; }

 private:
  void check(int status) const {
    if (status < 0) fail("CVODE says '{}' at t = {:.6g} s", CVodeGetReturnFlagName(status), t_);
  }

  static int derivative(double, N_Vector y, N_Vector dydt, void* self) {
    auto& me = *static_cast<Cvode*>(self);
    if (++me.evaluations_ > most_evaluations) return -1;
    const auto& [body, law, bulge, v0, x0] = me.scene_;
    const double v = NV_Ith_S(y, 0);
    double D = 0;
    if (bulge.length > 0) {
      const double z = NV_Ith_S(y, 1), dz = (v * law(std::abs(v)) - std::abs(v) * z) / bulge.length;
      NV_Ith_S(dydt, 1) = dz;
      D = z + bulge.damping * dz;
    } else {
      D = law(std::max(v, me.floor_));
    }
    NV_Ith_S(dydt, 0) = accelerate(body, D).a;
    return 0;
  }
  static int above_floor(double, N_Vector y, double* g, void* self) {
    g[0] = NV_Ith_S(y, 0) - static_cast<Cvode*>(self)->floor_;
    return 0;
  }
  static SUNContext new_context() {
    SUNContext context = nullptr;
    if (SUNContext_Create(0, &context) != 0) fail("CVODE gives no context");
    return context;
  }

  template <typename Handle>
  using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, void (*)(Handle)>;

  Scene scene_;
  double floor_;
  Owned<SUNContext> context_ = own(
      new_context(), +[](SUNContext context) { SUNContext_Free(&context); });
  Owned<N_Vector> y_{nullptr, nullptr};
  Owned<SUNMatrix> matrix_{nullptr, nullptr};
  Owned<SUNLinearSolver> solver_{nullptr, nullptr};
  Owned<void*> cvode_{nullptr, nullptr};
  double t_ = 0;
  bool stopped_ = false;
  unsigned long evaluations_ = 0;
};

}  // namespace rolling

#endif
