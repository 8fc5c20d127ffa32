// SPDX-License-Identifier: GPL-3.0-or-later
// The free roll on a track of any height, with its derivatives.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "motion/leg.h"
#include "ode/integrator.h"

namespace rolling {

/// With sin(theta) = h' + slope, the curvature k, the normal acceleration N = g cos(theta) + k v^2
/// and the speed u along the motion,
///   du/dt = -(D N + A R g sin(theta)) / ((K + A) R).
/// It is not autonomous, so that x and v are integrated together, by two clocks. From point to
/// point of the table, where the spline is smooth, E = u^2/2 and t are functions of x. Near a
/// turning point x and t are functions of u = w^4, so that the turn is the end of an interval. The
/// derivatives by the parameters are taken at a fixed clock, x or u. At the turn those at fixed u
/// are continuous, and those at a fixed time jump as dv/dt does.
///
/// A body that the track holds at a turning point rests. A speed below 1e-10 of the highest counts
/// as rest.
class RoadRoll : OdeSystem {
 public:
  using Point = Leg::Point;
  /// From x0 with v0, which may be below 0, on body.road, whose heights are multiplied by
  /// body.steepness; with this error of a step. Errors as those of Leg, and where x0 is outside of
  /// the table.
  RoadRoll(const Body&, const Law&, double v0, double x0, double tolerance = 1e-12);
  RoadRoll(const RoadRoll&) = delete;  // the integrator refers to it
  RoadRoll& operator=(const RoadRoll&) = delete;

  /// The state at t >= 0, x counted from x0. Throws Error if the body leaves the track or the table
  /// before.
  Point at(double t);
  /// The first turning point, or the rest [s].
  double stop_time() { return turn(INFINITY)->begin[0]; }
  double stop_until(double t);  ///< it, if it is not later than t, else infinity
  Leg::Derivatives stop_time_by_c();
  /// True if the body rolls on after stop_time().
  bool turns() { return !turn(INFINITY)->rests(); }
  unsigned long evaluations() const { return ode_->evaluations(); }  ///< so far

 private:
  using State = std::vector<double>;  // t, x, E or w, and two derivatives by each parameter
  struct Rate {
    double a;         // du/dt
    double a_u, a_x;  // its derivatives
    double N;
    Leg::Derivatives a_p;  // by the parameters
  };
  /// A piece of the motion by one clock.
  struct Segment {
    double way;     // the direction of the motion
    double change;  // 0: the clock is x; else w, which falls (-1) or grows (1)
    double length;  // of the clock; 0 of the rest
    State begin;
    bool of_place() const { return change == 0; }
    bool rests() const { return length == 0; }
    double speed(double clock) const;  // at this E or w
  };

  Rate rate(double u, double x, double way) const;
  bool holds(double x, double way) const;
  double next_point(double x, double way) const;
  double bend(double u, double x, double way) const;
  void derivative(const double* y, double* dy) const override;
  State along(const Segment&, const State& from, double length);
  void to_speed(State&, double way) const;
  void to_place(State&, double way) const;
  Segment from_rest() const;
  Segment onwards();
  void add_segment();
  const Segment* turn(double t);
  Point point(const Segment&, const State&, double after) const;
  [[noreturn]] void leaves(const char* what) const;

  Body body_;
  Law with_, against_;  // in the wind of a motion towards growing and falling x
  double x0_, highest_;
  std::size_t count_;  // of the parameters, beside v0 and x0, which are the first
  std::vector<Segment> segments_;
  State end_;              // of the last one
  bool in_place_ = false;  // its clock is x; else w, which is 0
  double heading_;         // the direction of the motion; at rest that of the last one
  double way_ = 1, change_ = 0, pace_ = 1;  // of the piece that is being integrated
  State here_;                              // of the time that was asked for last,
  std::size_t of_here_ = 0;                 // in this segment
  std::optional<Integrator> ode_;
};

}  // namespace rolling
