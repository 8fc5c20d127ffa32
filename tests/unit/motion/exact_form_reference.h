// SPDX-License-Identifier: GPL-3.0-or-later
// The roll in exact geometry in 60 decimal digits, for the numbers given as doubles: independent of
// speed_integrals.
#pragma once

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "contact/body.h"
#include "law/law.h"
#include "unit/motion/random_scene.h"

namespace rolling {

/// With z = (D(v0)/R)^2 e^(-2 b y), y = ln(v0/v) and s = 1 - b:
///   t = unit int_0^y (K + A) / (K + 1) e^(-s u) du, A = sqrt(1 - z), and the distance the same
///   with s + 1 times v0.
/// Where z <= 3/4 by the binomial series of A, above by tanh-sinh quadrature over u or A, du = A dA
/// / (b z).
class ExactFormReference {
 public:
  using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>,
                                             boost::multiprecision::et_off>;

  ExactFormReference(const Body& c, PowerLaw law, double v0)
      : K_(c.K), b_(law.b), s_(1 - Real(law.b)), v0_(v0) {
    const Real D = law.a * pow(Real(v0), b_);
    unit_ = (K_ + 1) * c.R * v0 / (c.g * D);
    depth_ = D * D / c.R / c.R;
    Real term = 1;
    for (int n = 0; abs(term) * pow(Real(0.75), n) > 1e-50;
         term *= Real(2 * n - 1) / (2 * n + 2), ++n)
      binomials_.push_back(term);
  }

  struct Errors {
    double v, x;            // relative
    double v_by_t, x_by_t;  // what an error of t, relative, makes of them
  };
  /// Of v and x at time t: by a step of Newton's method from the time at which v is right.
  Errors errors(double t, double v, double x) const {
    const Real y = log(v0_ / v), late = t - unit_ * integral(s_, y),
               rate = exp(s_ * y) / (unit_ * (K_ + A(z(y))) / (K_ + 1));
    const Real distance = v0_ * unit_ * integral(s_ + 1, y) + v * late;
    return {static_cast<double>(late * rate), static_cast<double>(x / distance - 1),
            static_cast<double>(t * rate), static_cast<double>(t * v / distance)};
  }

 private:
  Real z(const Real& y) const { return depth_ * exp(-2 * b_ * y); }
  static Real A(const Real& z) { return sqrt(std::max(Real(0), Real(1 - z))); }

  /// int_0^y (K + A) / (K + 1) e^(-p u) du
  Real integral(const Real& p, const Real& y) const {
    const Real border =
        depth_ == 0 || b_ == 0 ? Real(0) : Real(log(depth_ / 0.75) / (2 * b_));  // there z = 3/4
    const Real middle = std::clamp(border, Real(0), y);
    const bool deep_first = depth_ > 0.75;
    if (b_ == 0) return (K_ + A(depth_)) * power(p, y) / (K_ + 1);
    return ((deep_first ? deep(p, 0, middle) : series(p, 0, middle)) +
            (b_ < 0 ? deep(p, middle, y) : series(p, middle, y))) /
           (K_ + 1);
  }
  static Real power(const Real& p, const Real& y) {
    return abs(p * y) < 1e-40 ? y : Real(-expm1(-p * y) / p);
  }

  Real series(const Real& p, const Real& from, const Real& to) const {
    const Real width = to - from, z_from = z(from), largest = std::max(z_from, z(to));
    if (width == 0) return 0;
    Real sum = K_ * power(p, width), power_of_z = 1;
    const Real ratio = exp(-2 * b_ * width);
    Real e = exp(-p * width), most = 1;
    for (std::size_t n = 0; n < binomials_.size() && most > 1e-50;
         ++n, power_of_z *= z_from, most *= largest, e *= ratio) {
      const Real exponent = p + 2 * b_ * n;
      sum += binomials_[n] * power_of_z *
             (abs(exponent * width) < 1e-10 ? power(exponent, width) : Real((1 - e) / exponent));
    }
    return exp(-p * from) * sum;
  }

  Real deep(const Real& p, const Real& from, const Real& to) const {
    if (from == to) return 0;
    const auto integral = [](const Real& lo, const Real& hi, auto integrand) {
      static boost::math::quadrature::tanh_sinh<Real> quadrature(12);
      const Real half = (hi - lo) / 2, middle = (hi + lo) / 2;
      return half * quadrature.integrate(
                        [&](const Real& x) { return Real(integrand(Real(middle + half * x))); },
                        Real(-1), Real(1), Real(1e-28));
    };
    const Real first = A(z(from)), last = A(z(to));
    if (abs(last - first) < std::min(first, last))  // far from the root of A
      return integral(from, to, [&](const Real& u) { return Real((K_ + A(z(u))) * exp(-p * u)); });
    return integral(first, last, [&](const Real& A) {
      const Real z = 1 - A * A;
      return Real((K_ + A) * A / (b_ * z) * exp(p / (2 * b_) * log(z / depth_)));
    });
  }

  Real K_, b_, s_, v0_, unit_, depth_;
  std::vector<Real> binomials_;  // of A = sqrt(1 - z), by powers of z
};

}  // namespace rolling
