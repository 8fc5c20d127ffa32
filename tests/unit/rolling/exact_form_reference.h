// The roll in exact geometry in 60 decimal digits, for the numbers given as doubles: independent of speed_integrals.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

#include "rolling/body.h"
#include "rolling/power_law.h"
#include "unit/rolling/closed_form_reference.h"

namespace rolling {

/// With depth = (D(v0)/R)^2, y = ln(v0/v) and s = 1 - b the time is a sum,
///   t = unit int_0^y (K + A) / (K + 1) e^(-s u) du, A = sqrt(1 - depth e^(-2 b u)), and the distance the same with s + 1 times v0.
class ExactFormReference {
 public:
  using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>, boost::multiprecision::et_off>;

  ExactFormReference(const Body& c, PowerLaw law, double v0)
      : K_(c.K), b_(law.b), s_(1 - Real(law.b)), v0_(v0) {
    const Real D = law.a * pow(Real(v0), b_);
    unit_ = (K_ + 1) * c.R * v0 / (c.g * D);
    depth_ = D * D / c.R / c.R;
    // The binomial series of the square root; beyond 60 digits what is left is no more than its last term / (1 - depth).
    Real term = 1;
    for (int n = 0; abs(term) > 1e-50 * (1 - depth_); term *= depth_ * (2 * n - 1) / (2 * n + 2), ++n) terms_.push_back(term);
  }

  struct Errors {
    double v, x;  // relative
  };
  /// Of v and x at time t: by a step of Newton's method from the time at which v is right.
  Errors errors(double t, double v, double x) const {
    const Real y = log(v0_ / v), late = t - unit_ * integral(s_, y), A = sqrt(1 - depth_ * exp(-2 * b_ * y));
    const Real distance = v0_ * unit_ * integral(s_ + 1, y) + v * late;
    return {static_cast<double>(late * exp(s_ * y) / (unit_ * (K_ + A) / (K_ + 1))), static_cast<double>(x / distance - 1)};
  }

 private:
  Real integral(const Real& s, const Real& y) const {
    const auto power = [&](const Real& p, const Real& e) { return abs(p * y) < 1e-40 ? y : Real((1 - e) / p); };
    const Real ratio = exp(-2 * b_ * y);
    Real e = exp(-s * y), sum = K_ * power(s, e);
    for (std::size_t n = 0; n < terms_.size(); ++n, e *= ratio) sum += terms_[n] * power(s + 2 * b_ * n, e);
    return sum / (K_ + 1);
  }
  Real K_, b_, s_, v0_, unit_, depth_;
  std::vector<Real> terms_;
};

/// Changes a so that D(v0) is part of R.
inline void deepen(RandomScene& scene, double part) { scene.law.a = part * scene.body.R * std::pow(scene.v0, -scene.law.b); }

}  // namespace rolling
