// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/scene.h"

#include <cmath>

#include "base/error.h"
#include "contact/contact.h"
#include "motion/solved_roll.h"
#include "motion/roll.h"

namespace rolling {

namespace {

/// The motion of a Roll.
class SpeedRoll final : public Motion {
 public:
  SpeedRoll(const Scene& scene, double tolerance)
      : roll_(scene.body, scene.law, scene.v0, scene.x0, tolerance), x0_(scene.x0) {
    seek(0);
  }

  double stop_time() override {
    const double stop = roll_.stop_time();
    return std::isfinite(stop) && roll_.radius_time(stop) < stop ? INFINITY : stop;
  }
  double last_speed() override { return roll_.last_speed(); }
  void seek(double t) override {
    state_ = roll_.at(t);
    if (const double end = roll_.radius_time(t); t > end)
      fail("at t = {:.6g} s the shift has grown to the radius {:.6g} m", end, roll_.body().R);
    roll_.law().check_speed(state_.v);
  }
  double position() override { return x0_ + state_.x; }
  double velocity() override { return state_.v; }
  double acceleration() override {
    if (state_.a == 0 || roll_.body().road) return 0 + state_.a;  // no -0
    return acceleration_from_shift(roll_.body(), shift());
  }
  double shift() override {
    const double D = roll_.law()(state_.v);
    check_shift(roll_.body(), D);
    return D;
  }
  Roll* roll() override { return &roll_; }
  unsigned long evaluations() const override { return roll_.evaluations(); }

 private:
  Roll roll_;
  double x0_;
  Roll::Point state_{};
};

/// The integrals of Roll are closed forms there (Eq. 13).
bool has_closed_form(const Scene& s) {
  return s.law.power() && !s.body.exact && s.body.slope == 0 && !s.body.road;
}

}  // namespace

Method best_method(const Scene& scene) {
  if (scene.bulge.length > 0) return {Method::solver, memory_stepper(scene)};
  return {has_closed_form(scene) ? Method::closed : Method::exact};
}

std::unique_ptr<Motion> start(const Scene& scene, Method method, double rtol,
                              unsigned long most_steps) {
  const auto& [body, law, bulge, v0, x0] = scene;
  if (!std::isfinite(x0)) fail("the initial position x0 = {} must be finite", x0);
  check_roll(body, law, v0);
  if (body.road && method.kind == Method::solver)
    fail("a track with a height has no other method than exact, and no memory");
  if (bulge.length > 0) {
    if (method.kind != Method::solver)
      fail(
          "a bulge with memory has no closed form and no integral over speed: its methods are the "
          "solvers");
    if (v0 == 0 && body.slope != 0)
      fail("v0 = 0: the memory of a mat at rest does not hold a body on a slope: say a small v0");
    return std::make_unique<MemoryRoll>(scene, method.stepper, rtol, most_steps);
  }
  if (method.kind == Method::solver)
    return std::make_unique<IntegratedRoll>(scene, method.stepper, rtol, most_steps);
  if (method.kind == Method::closed && !has_closed_form(scene))
    fail("the closed form is that of a law a v^b with A = 1 on a level mat: take the method exact");
  return std::make_unique<SpeedRoll>(scene, rtol);
}

}  // namespace rolling
