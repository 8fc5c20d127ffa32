// SPDX-License-Identifier: GPL-3.0-or-later
// The free roll under any law D(v), on a mat of any slope and in either geometry, as a function of
// time, with its derivatives by the coefficients of the law, by the slope, by the wind and by v0.
#pragma once

#include <memory>
#include <optional>

#include "motion/leg.h"
#include "motion/road_roll.h"

namespace rolling {

/// Throws Error as Roll does, and unless a v^b has a > 0 and |b| <= 1000, and D <= R at v0, or at
/// all points of a table up to there.
void check_roll(const Body&, const Law&, double v0);

/// A roll is one leg, or two. Where the mat rises along the motion more than the law can hold at
/// rest, A R S > D(0), the body rolls back from its turning point: D always acts against the
/// motion. If the way back would not be faster than 1e-6 v0, it counts as rest. From v0 = 0 a body
/// that the mat does not hold begins to roll down. A head wind may blow a body back, too, which is
/// then in a tail wind.
///
/// On a road of any height it is a RoadRoll.
///
/// In the exact geometry D may grow to R as the body slows down. There it stays, so that A = 0 and
/// v' = -g cos(theta)/K (Eq. 12) down to the stop; with A = 1, Eq. 12 holds for any D.
///
/// v and x are within 1e-13 of v0 and of the way, derivatives within 1e-9, but within 2e-8 where
/// the speed comes near to its last one. x and v0 count along the motion, so the slope and the wind
/// of the Body are those that this roll sees: whoever describes a roll towards falling x by v0 > 0
/// turns their signs.
class Roll {
 public:
  static constexpr std::size_t most = Leg::most;
  using Point = Leg::Point;
  using Derivatives = Leg::Derivatives;

  /// Throws Error unless R > 0, g > 0, K >= 0, v0 >= 0, all of them and the slope finite; where the
  /// law, which may be a table, does not reach up to v0 or has no finite value there; and in the
  /// exact geometry for D(v0) > R.
  /// x0 and the tolerance are those of a RoadRoll, whose errors it has then; there v0 may be below
  /// 0.
  Roll(const Body&, const Law&, double v0, double x0 = 0, double tolerance = 1e-12);

  /// The state at t >= 0 [s], x counted from 0, and its partial derivatives at fixed t: by v0, by
  /// the coefficients of the law and, behind them, by the slope and the wind. Once the body rests,
  /// v is 0 with derivatives 0.
  Point at(double t);

  /// When v becomes 0 [s], for good or at the first turning point; infinity if it never does. A
  /// last speed below 1e-6 v0, which a falling mat may leave, counts as rest.
  double stop_time() { return road_ ? road_->stop_time() : ahead_.stop_time(); }
  /// The same if it is not later than t, else infinity.
  double stop_until(double t) { return road_ ? road_->stop_until(t) : ahead_.stop_until(t); }
  Derivatives stop_time_by_c() { return road_ ? road_->stop_time_by_c() : ahead_.stop_time_by_c(); }
  /// The speed at the stop: 0, or that just named.
  double rest_speed() const { return ahead_.rest_speed(); }
  /// Of the first leg, as in Leg.
  double radius_time(double t) { return ahead_.radius_time(t); }
  double radius_speed() const { return ahead_.radius_speed(); }
  /// True if the body rolls back after stop_time().
  bool turns() { return road_ ? road_->turns() : turns_; }
  /// The direction in which it rolls then: -1, but 1 for one that begins at rest and rolls forward.
  double way_on() const { return way_on_; }
  /// The limit of v for a body that rolls for ever [m/s], which may be infinite; else 0.
  double last_speed() { return turns_ ? way_on_ * back().last_speed() : ahead_.last_speed(); }
  /// Of the differential equations of a road, so far.
  unsigned long evaluations() const { return road_ ? road_->evaluations() : 0; }

  const Body& body() const { return body_; }
  const Law& law() const { return law_; }  ///< in the wind

 private:
  bool holds(double way) const;
  Leg& back();

  Body body_;
  Law law_;
  double v0_;
  Leg ahead_;                       // on a road of no length
  std::optional<Leg> back_;         // if it has been asked for
  std::shared_ptr<RoadRoll> road_;  // if the body has one; shared by copies
  double way_on_;
  bool turns_;
};

}  // namespace rolling
