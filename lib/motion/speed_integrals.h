// Time, distance and their derivatives as dimensionless integrals over speed, for D(v) = a v^b in
// either geometry.
#pragma once

#include <limits>
#include <variant>
#include <vector>

#include "motion/speed_arm.h"
#include "motion/speed_panel.h"
#include "motion/speed_series.h"
#include "motion/wanted.h"

namespace rolling {

/// With y = ln(v0/u), s = 1 - b, and f, z and A of SpeedArm, the time is the integral of f e^(-s y)
/// over y and the distance that of f e^(-(s+1) y).
///
/// The range of y is divided into pieces. Where z <= 1/4 and b > 0, one SpeedSeries takes the whole
/// range. SpeedPanels take larger z, where the series converges slowly, and b < 0, where z grows
/// with y.
class SpeedIntegrals {
 public:
  /// depth = D(v0)/R in 0 .. 1, and 0 for A = 1; arm_square = 1 - depth^2, from a caller who knows
  /// it without cancellation. K + A must not be 0.
  SpeedIntegrals(double b, double K, double depth, double arm_square);
  SpeedIntegrals(double b, double K, double depth)
      : SpeedIntegrals(b, K, depth, (1 - depth) * (1 + depth)) {}

  /// int_0^inf f e^(-s y) dy: the time to the stop; infinity if there is no stop.
  double stop() const { return stop_; }
  /// The time at which D reaches R on the way down (b < 0); infinity if it never does.
  double end() const { return end_; }
  /// The y where D reaches R, if it does.
  double last() const { return pieces_.back().y + pieces_.back().width; }

  /// lambda with int_0^lambda f e^(-s y) dy = time, for time below stop() and up to end(). `rest`
  /// is stop() - time, from the caller, who may know it without cancellation; infinite when stop()
  /// is.
  double lambda(double time, double rest) const;

  /// f at y = lambda.
  double f(double lambda) const { return arm_.f(lambda); }
  /// int_0^lambda f e^(-(s+1) y) dy.
  double distance(double lambda) const;

  /// int (1 - f) e^(-s y) dy, from 0 to lambda and from lambda to infinity (for s > 0): the
  /// difference to the geometry A = 1.
  double lag(double lambda) const;
  double lag_rest(double lambda) const;

  /// The integrals that the derivatives need; for Wanted::speed only h0 and h1.
  SpeedGradient gradient(double lambda, Wanted = Wanted::speed_and_distance) const;

 private:
  struct Sums {
    double time = 0, lag = 0;
    SpeedGradient gradient;
  };
  struct Piece {
    double y, width;  // beginning and length of the piece
    double power;     // e^(-s y): the piece's unit of time
    std::variant<SpeedPanel, SpeedSeries> integrals;
    Sums before;            // the integrals from 0 to y
    double rest, lag_rest;  // time and lag from y to the stop; infinite if there is none

    double time(double local) const;
    double lag(double local) const;
    double distance(double local) const;
    SpeedGradient gradient(double local, Wanted) const;
    double local(double lambda) const { return std::min(lambda - y, width); }
  };

  void add(double y, double width, std::variant<SpeedPanel, SpeedSeries>);
  void add_panels(double from, double to);
  void add_up_from_stop(double last);
  Sums sums_to_end(const Piece&) const;
  SpeedGradient gradient(const Piece&, double local, Wanted) const;
  const Piece& piece_at(double lambda) const;

  SpeedArm arm_;
  double s_;
  std::vector<Piece> pieces_;
  double stop_ = std::numeric_limits<double>::infinity();
  double end_ = std::numeric_limits<double>::infinity();
};

}  // namespace rolling
