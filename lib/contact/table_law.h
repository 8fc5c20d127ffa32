// SPDX-License-Identifier: GPL-3.0-or-later
// A law D(v) given by points, with monotone interpolation.
#pragma once

#include <cstddef>
#include <vector>

namespace rolling {

/// Interpolates by cubics with the slopes of Steffen (1990, Astron. Astrophys. 239, 443), and at
/// the first and the last point with that of the line to the next one: monotone between two points,
/// with a continuous derivative. Below the lowest point D is constant; above the highest point the
/// law is not defined.
class TableLaw {
 public:
  /// Points in any order, with v [m/s] >= 0, D [m] > 0 and all v different; else it throws Error.
  TableLaw(std::vector<double> v, std::vector<double> D);

  /// D [m] and dD/dv [s] at 0 <= v <= highest(). Above that D continues with the last slope, only
  /// for the trial steps of a solver.
  double operator()(double v) const;
  double slope(double v) const;

  const std::vector<double>& speeds() const { return v_; }  ///< increasing [m/s]
  double highest() const { return v_.back(); }
  double largest_shift(double v) const;  ///< largest D at speeds up to v [m]

 private:
  struct Place {
    std::size_t i;
    double s;  // v - v_[i]
  };
  Place place(double v) const;

  std::vector<double> v_, D_;
  std::vector<double> c1_, c2_, c3_;  // D = D_[i] + s (c1 + s (c2 + s c3))
};

}  // namespace rolling
