// The roll with the paper's A = 1: Eq. 13, without its failure near b = 1 and its overflow.
#pragma once

#include "rolling/trajectory.h"

namespace rolling {

/// b < 1 stops at t* = v0^(1-b) / ((1-b) a c), c = g / ((K+1) R), and v is exactly 0 from there on; b >= 1 never stops.
/// Refusals as in Trajectory.
class ClosedForm final : public TrajectoryMotion {
 public:
  ClosedForm(const Body& body, PowerLaw law, double v0, double x0)
      : TrajectoryMotion(body, Geometry::approximate, law, v0, x0) {}
};

}  // namespace rolling
