// The roll with A = sqrt(1 - D^2/R^2) (Eqs. 8, 12).
#pragma once

#include "rolling/motion.h"
#include "rolling/trajectory.h"

namespace rolling {

/// Relative error about 1e-14 up to D(v0) = R, as far as t lets the stop be told from the time just before it. Refusals, and
/// what b < 0 means, as in Trajectory.
class ExactForm final : public Motion {
 public:
  ExactForm(const Body&, PowerLaw, double v0, double x0);

  double stop_time() const override { return trajectory_.stop_time(); }
  void seek(double t) override;
  double position() override { return x0_ + trajectory_.position(t_, lambda_); }
  double velocity() override { return trajectory_.velocity(lambda_); }
  double acceleration() override { return trajectory_.acceleration(velocity()); }
  double shift() override { return trajectory_.shift(velocity()); }

 private:
  Trajectory trajectory_;
  double x0_;
  double t_ = 0;
  double lambda_ = 0;
};

}  // namespace rolling
