// The roll with A = sqrt(1 - D^2/R^2) (Eqs. 8, 12).
#pragma once

#include "rolling/trajectory.h"

namespace rolling {

/// Relative error about 1e-14 up to D(v0) = R, as far as t lets the stop be told from the time just before it. Refusals, and
/// what b < 0 means, as in Trajectory.
class ExactForm final : public TrajectoryMotion {
 public:
  ExactForm(const Body& body, PowerLaw law, double v0, double x0)
      : TrajectoryMotion(body, Geometry::exact, law, v0, x0) {}
};

}  // namespace rolling
