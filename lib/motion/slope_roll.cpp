#include "motion/slope_roll.h"

#include <cmath>

#include "base/error.h"

namespace rolling {

SlopeRoll::SlopeRoll(const Body& body, Geometry geometry, PowerLaw law, double v0, double x0)
    : trajectory_(body, geometry, law, v0), x0_(x0), v_(v0) {
  if (!std::isfinite(x0)) fail("the initial position x0 = {} must be finite", x0);
}

void SlopeRoll::seek(double t) {
  t_ = t;
  v_ = t < stop_time() ? trajectory_.speed_at(t).v : 0;
}

double SlopeRoll::acceleration() { return v_ == 0 ? 0 : trajectory_.acceleration(v_); }

}  // namespace rolling
