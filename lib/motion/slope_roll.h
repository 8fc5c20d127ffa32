// The roll under D(v) = a v^b on a mat that is not level, in either geometry.
#pragma once

#include "motion/motion.h"
#include "motion/trajectory.h"

namespace rolling {

/// Time and distance are integrals over speed, computed by Trajectory. The relative error is about
/// 1e-14.
class SlopeRoll final : public Motion {
 public:
  /// Throws Error as check_roll does.
  SlopeRoll(const Body& body, Geometry geometry, PowerLaw law, double v0, double x0)
      : trajectory_(body, geometry, law, v0), x0_(x0), v_(v0) {}

  double stop_time() const override { return trajectory_.stop_time(); }
  double last_speed() const override { return trajectory_.last_speed(); }
  void seek(double t) override {
    t_ = t;
    v_ = t < stop_time() ? trajectory_.speed_at(t).v : 0;
  }
  double position() override { return x0_ + trajectory_.at(t_).x; }
  double velocity() override { return v_; }
  double acceleration() override { return v_ == 0 ? 0 : trajectory_.acceleration(v_); }
  double shift() override { return trajectory_.shift(v_); }

 private:
  Trajectory trajectory_;
  double x0_, t_ = 0, v_;
};

}  // namespace rolling
