// The free roll under D(v) = a v^b in either geometry, as a function of time and of its parameters.
// ExactForm and the trajectory fits both use it.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "contact/body.h"
#include "contact/contact.h"
#include "contact/power_law.h"
#include "motion/slope_integrals.h"
#include "motion/speed_integrals.h"
#include "motion/wanted.h"

namespace rolling {

/// Throws Error unless R > 0, g > 0, K >= 0, a > 0, v0 >= 0, all of them and the slope finite,
/// |b| <= 1000, and D(v0) <= R.
void check_roll(const Body&, PowerLaw, double v0);

/// The law is autonomous, so time and distance are integrals over speed (Eq. 12):
///   t = int_v^v0 (K + A(u)) R / (g a u^b) du,   x = int_v^v0 (K + A(u)) R / (g a u^b) u du.
/// They are taken in lambda = ln(v0 / v), which is found from t: in closed form for A = 1 (Eq. 13),
/// by Newton else.
///
/// Exact geometry with b < 0: D grows as the body slows down and reaches R at a speed v_R > 0,
/// where the law loses its meaning. AtRadius says what follows. Where v_R is so small that the time
/// below it does not show in a double (b near 0), the body stops like any other.
///
/// A mat that is not level (Body::slope) adds the slope's part of gravity; the same integrals are
/// then taken by SlopeIntegrals. x and v >= 0 count along the motion, so the slope of the Body is
/// the one that this roll sees: whoever describes a roll towards falling x by v0 > 0 turns the sign
/// of the slope. A body that has come to rest is taken to stay there: the law has no friction of
/// rest.
class Trajectory {
 public:
  /// By which parameters at() and speed_at() differentiate.
  enum class Derivatives { of_law, of_law_and_slope };
  /// What follows where D reaches R.
  enum class AtRadius {
    ends,   ///< the roll ends there: later times throw Error, and stop_time() is infinite
    passed  ///< for fits, whose search needs a value at every time, continuous in the law. In the
            ///< exact geometry D then stays R, so that A = 0 and v' = -g cos(theta)/K (Eq. 12) down
            ///< to the stop; with A = 1 Eq. 12 holds for any D, at v0 too
  };

  /// Refuses what check_roll refuses, but not a D(v0) that is passed. v0 = 0 is rest for ever.
  Trajectory(const Body&, Geometry, PowerLaw, double v0, Derivatives = Derivatives::of_law,
             AtRadius = AtRadius::ends);

  /// State at time t, x counted from 0 at t = 0, and the exact partial derivatives at fixed t by a,
  /// b, v0 and the slope S. v_S and x_S are 0 unless they are asked for or the mat is not level.
  struct Point {
    double v, x;
    double v_a, v_b, v_v0;
    double x_a, x_b, x_v0;
    double v_S = 0, x_S = 0;
  };

  /// When v becomes 0 [s]; infinity if the body never stops. On a falling mat the speed may tend to
  /// last_speed(); one below 1e-6 v0 counts as rest, from the moment when v is twice as large.
  double stop_time() const { return stop_time_; }
  /// The speed of a body that never stops after a long time [m/s]: 0 for b >= 1 on a level mat, the
  /// speed at which the law balances a falling mat, or infinity.
  double last_speed() const { return incline_ ? v0_ * incline_->last_speed() : 0; }
  /// The speed that counts as rest [m/s]: 0, or that of the moment just named.
  double rest_speed() const { return incline_ ? v0_ * incline_->rest_speed() : 0; }
  /// When D reaches R (b < 0) [s], infinity if it never does; and v there [m/s], or 0.
  double radius_time() const { return radius_time_; }
  double radius_speed() const { return radius_speed_; }
  /// Up to this time v and x are smooth functions of time [s].
  double smooth_until() const { return std::min(stop_time_, radius_time_); }

  /// t >= 0 [s]. From the stop on: v = 0 with zero derivatives, x the stopping distance with its
  /// derivatives.
  Point at(double t) const { return at(t, Wanted::speed_and_distance); }
  /// The same without x and its derivatives, which are left 0, in half the time; for A = 1 in
  /// closed form, in a quarter of it.
  Point speed_at(double t) const;
  /// x alone, in less than half the time where the mat is level.
  double distance_at(double t) const { return incline_ ? at(t).x : position(t, log_ratio(t)); }

  // For level mats alone:
  /// ln(v0 / v) at time t >= 0; infinity from the stop on.
  double log_ratio(double t) const { return log_ratio(t, stop_time_ - t); }
  /// The same for one who knows stop_time() - t without cancellation.
  double log_ratio(double t, double rest) const;
  /// v [m/s], from log_ratio(t).
  double velocity(double lambda) const;
  /// x [m] at time t, from log_ratio(t).
  double position(double t, double lambda) const;
  const SpeedIntegrals& integrals() const { return integrals_; }

  /// D [m] and dv/dt [m/s^2] at speed v. Throw Error where |D| > R (A = 1 and b < 0, just before
  /// the stop), unless it is passed.
  double shift(double v) const;
  double acceleration(double v) const;

 private:
  struct ByParameters {
    double a, b, v0, S = 0;
  };
  Point at(double t, Wanted) const;
  Point on_slope(double t, Wanted) const;
  void check_time(double t) const;  // throws Error beyond radius_time_
  Point point_of(SlopeIntegrals::Place, Wanted) const;
  void stop_at_radius(const ByParameters& time);
  Point at_radius(double rest) const;
  double radius_deceleration() const { return body_.g * incline(body_).cos / body_.K; }
  double fall() const;
  bool rolls_at_radius(double t) const { return t > radius_time_ && t < stop_time_ && passed_; }
  /// stop_time_ - t for the integrals: infinite where they end at D = R.
  double rest_of_law(double rest) const {
    return radius_speed_ > 0 ? std::numeric_limits<double>::infinity() : rest;
  }

  Body body_;
  Geometry geometry_;
  PowerLaw law_;
  double v0_, log_v0_;
  double unit_ = 0;  // v0^(1-b) / (a c) [s]: v0 divided by the deceleration at v0 for A = 1; with
                     // incline_, v0 / (g cos theta)
  SpeedIntegrals integrals_;
  std::optional<SlopeIntegrals> incline_;  // where the mat is not level, or its slope a parameter
  double stop_time_ = 0;
  double radius_time_ = std::numeric_limits<double>::infinity(), radius_speed_ = 0;
  bool passed_;  // AtRadius::passed
  Point stopped_{};
  ByParameters stop_time_by_{};  // the derivatives of stop_time_, where D stays R
};

}  // namespace rolling
