// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/closed_form.h"

#include <cmath>

#include "base/error.h"
#include "contact/contact.h"

namespace rolling {

namespace {

constexpr double unseen = 1e-20;  // for rate t below it, v = v0 in a double
constexpr double beyond = 1e140;  // for rate t above it, double-double products may overflow
constexpr double gone = -1e4;     // for L below it, v = 0 in a double

}  // namespace

ClosedForm::ClosedForm(const Body& body, PowerLaw law, double v0, double x0)
    : body_(body), b_(law.b), v0_(v0), x0_(x0) {
  if (v0 == 0) return;
  const DoubleDouble s = two_sum(1, -law.b), s1 = two_sum(2, -law.b);
  const DoubleDouble arm = two_sum(body.K, 1) * body.R / body.g;
  shift_ = exp(log(DoubleDouble(v0)) * law.b) * law.a, deceleration_ = shift_ / arm,
  rate_ = deceleration_ / v0;
  length_ = DoubleDouble(v0) / rate_, slope_ = -(s * rate_), s1_ = s1;
  if (s1.hi != 0) distance_ = length_ / s1;
  if (s.hi != 0) inverse_s_ = DoubleDouble(1) / s;
  stop_time_ = INFINITY;
  if (s.hi > 0) {
    const DoubleDouble stop = inverse_s_ / rate_;
    stop_time_ = stop.lo > 0 ? std::nextafter(stop.hi, stop_time_) : stop.hi;
  }
  seek(0);
}

void ClosedForm::seek(double t) {
  t_ = t;
  rolls_ = t < stop_time_;
  if (!rolls_) return;
  if (rate_.hi * t > beyond)
    fail("t = {} s is beyond the closed form: --method exact reaches it", t);
  const DoubleDouble minus_sq = slope_ * t;
  if (rate_.hi * t < unseen) {
    log_ = 0;
  } else if (std::abs(minus_sq.hi) < 0x1p-7) {
    log_ = quick_product(-rate_, log1p_ratio(minus_sq) * t);
  } else {
    const DoubleDouble w = minus_sq + 1;
    rolls_ = w.hi > 0;
    if (rolls_) log_ = quick_product(inverse_s_, quick_log(w));
  }
  if (log_.hi < gone) log_ = gone;
}

double ClosedForm::velocity() { return rolls_ ? times_exp(v0_, log_) : 0; }

double ClosedForm::position() {
  if (!rolls_) return x0_ + distance_.hi;
  if (log_.hi == 0) return x0_ + v0_ * t_;
  const DoubleDouble y = quick_product(s1_, log_),
                     x = std::abs(y.hi) < 1. / 32 ? quick_product(length_, -log_ * expm1_ratio(y))
                                                  : quick_product(distance_, one_minus_exp(y));
  return x0_ + (x.hi + x.lo);
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
