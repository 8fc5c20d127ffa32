// A law D(v) given by points: monotone between them, never beyond them.
#pragma once

#include <cstddef>
#include <vector>

namespace rolling {

/// Between two points a cubic with the slopes of Steffen (1990, Astron. Astrophys. 239, 443):
/// monotone where the points are, with a continuous derivative. Below the lowest point D keeps its
/// value; above the highest there is no law.
class TableLaw {
 public:
  /// Points in any order, v [m/s] >= 0 and D [m] > 0, all v different. Throws Error else.
  TableLaw(std::vector<double> v, std::vector<double> D);

  /// D [m], and dD/dv [s], at 0 <= v <= highest(). Above, D goes on with the last slope for solvers
  /// to try, and is no law.
  double operator()(double v) const;
  double slope(double v) const;

  const std::vector<double>& speeds() const { return v_; }  ///< increasing [m/s]
  double highest() const { return v_.back(); }
  double largest_shift(double v) const;  ///< of all speeds up to v [m]

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
