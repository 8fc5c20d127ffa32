// The roll with the paper's A = 1: Eq. 13 to the last bits, for every b.
#pragma once

#include "base/double_double.h"
#include "contact/body.h"
#include "motion/motion.h"
#include "contact/power_law.h"

namespace rolling {

/// With s = 1 - b, k = a g / ((K+1) R) and rate = k v0^-s:
///   w = 1 - s rate t = (v/v0)^s,   L = ln(v/v0) = ln(w) / s,   v = v0 e^L,
///   dv/dt = -k v0^b e^(b L),   x = x0 + v0/rate (1 - e^((1+s) L)) / (1+s).
/// b < 1 stops at t* = 1 / (s rate), and v is exactly 0 from there on; b >= 1 never stops.
///
/// The numbers given are taken as exact. Where digits are lost (rate, w, L) they are carried in
/// double-double: v, D and dv/dt are within 2 ulp and x within 4 ulp of the true value, before the
/// stop as long as t*/(t* - t) is below 1e13.
class ClosedForm final : public Motion {
 public:
  /// Refuses what check_roll refuses. v0 = 0 is rest for ever.
  ClosedForm(const Body&, PowerLaw, double v0, double x0);

  double stop_time() const override { return stop_time_; }  ///< t* rounded up
  void seek(double t) override;
  double position() override;
  double velocity() override;
  /// Both throw Error where |D| > R (b < 0, just before the stop).
  double acceleration() override;
  double shift() override;

 private:
  DoubleDouble far_log(double t) const;

  Body body_;
  double b_, v0_, x0_, stop_time_ = 0;
  // -s rate is slope_ unit1_ unit2_: two powers of two, as one could leave the range of a double.
  SplitFactor slope_;
  double unit1_ = 1, unit2_ = 1;
  Factor minus_rate_, inverse_s_, s1_, exponent_;       // -rate, divided like it; 1/s, 1 + s, b
  ScaledFactor speed_, shift_, deceleration_, length_;  // v0, a v0^b, k v0^b, v0/rate
  ScaledFactor distance_;                               // v0/rate / (1+s)

  double t_ = 0;
  DoubleDouble log_;  // L
  bool rolls_ = false;
};

}  // namespace rolling
