#include "contact/ledger.h"

namespace rolling {

Ledger::Ledger(const Body& c, Geometry geometry, double v, double D)
    : body_(c), incline_(incline(c)), v_(v), D_(D), A_(1), one_minus_A_(0) {
  if (geometry == Geometry::approximate) return;
  check_shift(c, D);
  A_ = arm_factor(c, geometry, D);
  one_minus_A_ = (D / c.R) * (D / c.R) / (1 + A_);  // does not cancel
}

// Here and in the header, 0 - x stands where a sign would do: rest then gives +0, not "-0".

// Eq. 9; on an incline F_H = m (v' + g sin theta) with v' of Eq. 12.
double Ledger::F_H() const {
  const Body& c = body_;
  return 0 - (D_ * incline_.cos - c.K * c.R * incline_.sin) * c.m * c.g / ((c.K + A_) * c.R);
}

double Ledger::tau_N() const { return 0 - D_ * F_N(); }

double Ledger::tau_H() const { return 0 - A_ * body_.R * F_H(); }

double Ledger::P_g() const { return body_.m * body_.g * incline_.sin * v_; }

}  // namespace rolling
