// SPDX-License-Identifier: GPL-3.0-or-later
// A law D(v) given by points, with monotone interpolation.
#pragma once

#include <cstddef>
#include <vector>

namespace rolling {

/// D at a speed, and its derivative by ln v [m].
struct Shift {
  double D, by_log_v;
};

/// Interpolates by cubics with the slopes of Steffen (1990, Astron. Astrophys. 239, 443), and at
/// the first and the last point with that of the line to the next one: monotone between two points,
/// with a continuous derivative. Below the lowest point D is constant; above the highest point the
/// law is not defined.
class TableLaw {
 public:
  /// Points in any order, with v [m/s] >= 0, D [m] > 0 and all v different; else it throws Error.
  TableLaw(std::vector<double> v, std::vector<double> D);

  /// At v [m/s] >= 0. Above the highest speed D continues with a constant slope, only for the trial
  /// steps of a solver.
  Shift at(double v) const;
  const std::vector<double>& speeds() const { return v_; }  ///< increasing [m/s]

 private:
  std::vector<double> v_, D_;
  std::vector<double> c1_, c2_, c3_;  // D = D_[i] + s (c1 + s (c2 + s c3))
};

}  // namespace rolling
