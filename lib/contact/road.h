// SPDX-License-Identifier: GPL-3.0-or-later
// The height of a track along the way of the body's centre.
#pragma once

#include <memory>
#include <vector>

namespace rolling {

/// A cubic spline through a table of heights h(x), where x is the way along the path, so that the
/// slope is sin(theta) = h' and the curvature h''/cos(theta). Its second derivative is constant
/// before the first inner point and behind the last one.
class Road {
 public:
  /// Throws Error unless there are two points or more, all finite, x increasing, and |h'| < 1.
  Road(std::vector<double> x, std::vector<double> h);

  /// The height and its derivatives.
  struct Place {
    double h, h1, h2, h3;
  };
  /// At x; beyond the ends the outermost cubics go on, only for the trial steps of a solver.
  Place at(double x) const;
  const std::vector<double>& points() const { return x_; }  ///< increasing
  /// The road as a body sees it that rolls towards falling x: h(-x).
  const Road* mirrored() const;
  double way() const { return way_; }  ///< -1 if it is mirrored
  /// Throws Error, with the x of the table, for a place outside of it.
  void check(double x) const;

 private:
  std::vector<double> x_, h_;
  std::vector<double> bend_;                      // the second derivatives at the points
  double way_ = 1;                                // -1 if mirrored
  mutable std::unique_ptr<const Road> mirrored_;  // if it has been asked for
};

}  // namespace rolling
