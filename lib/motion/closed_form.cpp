// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/closed_form.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/contact.h"
#include "motion/roll.h"

namespace rolling {

namespace {

constexpr double unseen = 1e-20;  // for rate t below it, v = v0 in a double
constexpr double beyond = 1e270;  // for rate t above it, double-double products overflow
constexpr double gone = -1e4;     // for L below it, v = 0 in a double

}  // namespace

ClosedForm::ClosedForm(const Body& body, PowerLaw law, double v0, double x0)
    : body_(body), b_(law.b), v0_(v0), x0_(x0) {
  check_roll(body, law, v0);
  if (v0 == 0) return;
  const DoubleDouble s = two_sum(1, -law.b), s1 = two_sum(2, -law.b);
  const Scaled arm = Scaled(two_sum(body.K, 1)) * Scaled(body.R) / Scaled(body.g), speed(v0);
  const Scaled shift = Scaled(law.a) * power(v0, law.b), deceleration = shift / arm,
               rate = deceleration / speed, length = speed / rate;
  speed_ = speed, shift_ = shift, deceleration_ = deceleration, length_ = length;
  if (s1.hi != 0) distance_ = length / Scaled(s1);
  minus_rate_ = -rate.m, slope_ = -(s * rate.m), s1_ = s1;
  unit1_ = std::ldexp(1, rate.exponent / 2),
  unit2_ = std::ldexp(1, rate.exponent - rate.exponent / 2);
  if (s.hi != 0) inverse_s_ = DoubleDouble(1) / s;
  if (s.hi <= 0) {
    stop_time_ = std::numeric_limits<double>::infinity();
  } else {
    const Scaled stop = Scaled(1.0) / (Scaled(s) * rate);
    const double up = stop.m.lo > 0 ? std::nextafter(stop.m.hi, 1) : stop.m.hi;
    stop_time_ = std::max(std::ldexp(up, stop.exponent), std::numeric_limits<double>::denorm_min());
  }
  seek(0);
}

void ClosedForm::seek(double t) {
  t_ = t;
  rolls_ = t < stop_time_;
  if (!rolls_) return;
  const double q = t * unit1_ * unit2_;  // rate t = -minus_rate_ q
  const DoubleDouble minus_sq = slope_ * q;
  if (q < unseen) {
    log_ = 0;
  } else if (q > beyond && slope_.hi > 0) {  // b > 1: w = -s rate t in a double
    log_ = quick_product(inverse_s_,
                         quick_log(slope_) + quick_log(t) + quick_log(unit1_) + quick_log(unit2_));
  } else if (q > beyond) {
    log_ = gone;
  } else if (std::abs(minus_sq.hi) < 0x1p-7) {
    log_ = quick_product(minus_rate_, log1p_ratio(minus_sq) * q);
  } else {
    const DoubleDouble w = minus_sq + 1;
    rolls_ = w.hi > 0;
    if (rolls_) log_ = quick_product(inverse_s_, quick_log(w));
  }
  if (log_.hi < gone) log_ = gone;
}

double ClosedForm::velocity() { return rolls_ ? times_exp(speed_, log_) : 0; }

double ClosedForm::position() {
  if (!rolls_) return x0_ + times(distance_, 1);
  if (log_.hi == 0) return x0_ + v0_ * t_;
  const DoubleDouble y = quick_product(s1_, log_);
  return x0_ + (std::abs(y.hi) < 1. / 32 ? times(length_, -log_ * expm1_ratio(y))
                                         : times(distance_, one_minus_exp(y)));
}

double ClosedForm::shift() {
  if (!rolls_) return 0;
  const double D = times_exp(shift_, quick_product(b_, log_));
  if (b_ < 0) check_shift(body_, D);  // for b >= 0, D falls from D(v0), which was checked
  return D;
}

double ClosedForm::acceleration() {
  if (!rolls_) return 0;
  if (b_ < 0) shift();
  return 0 - times_exp(deceleration_, quick_product(b_, log_));
}

}  // namespace rolling
