// SPDX-License-Identifier: GPL-3.0-or-later
// The roll in the paper's geometry A = 1: Eq. 13 to within a few ulp, for every b.
#pragma once

#include "base/double_double.h"
#include "contact/body.h"
#include "motion/scene.h"
#include "contact/law.h"

namespace rolling {

/// With s = 1 - b, k = a g / ((K+1) R) and rate = k v0^-s:
///   w = 1 - s rate t = (v/v0)^s,   L = ln(v/v0) = ln(w) / s,   v = v0 e^L,
///   dv/dt = -k v0^b e^(b L),   x = x0 + v0/rate (1 - e^((1+s) L)) / (1+s).
/// b < 1 stops at t* = 1 / (s rate), and v is exactly 0 from there on; b >= 1 never stops.
///
/// The parameters are taken as exact numbers. Intermediate results that lose digits (rate, w, L)
/// are in double-double arithmetic: before the stop, and as long as t*/(t* - t) is below 1e13, v, D
/// and dv/dt are within 2 ulp and x within 4 ulp of the true value.
class ClosedForm final : public Motion {
 public:
  /// For what check_roll accepts. v0 = 0 is rest for ever; else v0, a, D(v0), D(v0)/a and dv/dt at
  /// v0 are within 1e-70 to 1e70 (SI units).
  ClosedForm(const Body&, PowerLaw, double v0, double x0);

  double stop_time() override { return stop_time_; }  ///< t* rounded up
  void seek(double t) override;                       ///< throws Error for rate t above 1e140
  double position() override;
  double velocity() override;
  /// Both throw Error if |D| > R (b < 0, just before the stop).
  double acceleration() override;
  double shift() override;

 private:
  Body body_;
  double b_, v0_, x0_, stop_time_ = 0;
  DoubleDouble rate_, slope_, inverse_s_, s1_;             // slope_: -s rate
  DoubleDouble shift_, deceleration_, length_, distance_;  // a v0^b, k v0^b, v0/rate, that/(1+s)

  double t_ = 0;
  DoubleDouble log_;  // L
  bool rolls_ = false;
};

}  // namespace rolling
