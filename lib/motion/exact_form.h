// The roll in the exact geometry A = sqrt(1 - D^2/R^2) (Eqs. 8, 12).
#pragma once

#include "base/double_double.h"
#include "motion/motion.h"
#include "motion/trajectory.h"

namespace rolling {

/// Throws Error as Trajectory does, and for b < 0 returns the results of Trajectory. For b >= 0 one
/// Newton step in double-double refines lambda = ln(v0/v) of Trajectory. Let lag be the integral of
/// (1 - f) e^(-s y) over 0 < y < lambda (SpeedIntegrals), and lag' that over y > lambda. Then
///   e^(-s lambda) = 1 - s (t/unit + lag) = s ((T - t)/unit + lag').
/// t/unit, the stop T and the logarithm need double-double arithmetic; the lags are smooth and
/// small, so that doubles suffice. The relative errors of v and x are below 1e-13 until
/// (T - t)/T = 1e-9.
class ExactForm final : public Motion {
 public:
  ExactForm(const Body&, PowerLaw, double v0, double x0);

  double stop_time() const override { return stop_time_; }  ///< T rounded up
  void seek(double t) override;
  double position() override { return x0_ + trajectory_.position(t_, lambda_.hi); }
  double velocity() override;
  double acceleration() override { return trajectory_.acceleration(velocity()); }
  double shift() override { return trajectory_.shift(velocity()); }

 private:
  DoubleDouble refined(double lambda, DoubleDouble rest) const;

  Trajectory trajectory_;
  double x0_;
  bool refine_ = false;
  DoubleDouble s_, rate_, stop_;  // 1 - b, 1/unit, T
  double stop_time_;
  Factor minus_inverse_s_;
  ScaledFactor speed_;  // v0

  double t_ = 0;
  DoubleDouble lambda_;
};

}  // namespace rolling
