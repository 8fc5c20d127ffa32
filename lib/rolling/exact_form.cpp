#include "rolling/exact_form.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace rolling {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double shallowest_A = 1e-3;  // A(v0) below it: the continued fraction takes more than 32000 steps
constexpr double gone = 1e4;           // lambda above it: v is 0

/// s int_0^inf A e^(-s y) dy = F(-1/2, p; p+1; z) = p z^-p B_z(p, 3/2), p = s/(2b), with root = sqrt(1 - z): the continued fraction of the
/// incomplete beta function (DLMF 8.17.22), its factors multiplied by 2b, from the end. A step leaves (1 - root)/(1 + root) of the error.
DoubleDouble mean_arm(DoubleDouble s, double b, DoubleDouble z, DoubleDouble root) {
  DoubleDouble fraction = 1;
  for (double m = std::ceil(16 / std::atanh(std::min(root.hi, 0.999))) + 5; m >= 0; --m) {
    const DoubleDouble bm = two_product(2 * m, b), at = s + bm * 2;
    fraction = DoubleDouble(1) - (s + bm) * (s + bm + two_product(3, b)) * z / (at * (at + 2 * b) * fraction);
    if (m > 0) fraction = DoubleDouble(1) + bm * (two_product(3, b) - bm) * z / ((at - 2 * b) * at * fraction);
  }
  return root * root * root / fraction;
}

DoubleDouble value(const Scaled& x) { return {std::ldexp(x.m.hi, x.exponent), std::ldexp(x.m.lo, x.exponent)}; }

}  // namespace

ExactForm::ExactForm(const Body& body, PowerLaw law, double v0, double x0)
    : trajectory_(body, Geometry::exact, law, v0), x0_(x0), stop_(trajectory_.stop_time()), stop_time_(stop_.hi), speed_(Scaled(v0)) {
  if (!std::isfinite(x0)) fail("the initial position x0 = {} must be finite", x0);
  if (v0 > 0 && law.b >= 0) {
    const Scaled D = Scaled(law.a) * power(v0, law.b), rate = D / (Scaled(two_sum(body.K, 1)) * Scaled(body.R) / Scaled(body.g)) / Scaled(v0);
    refine_ = std::abs(rate.exponent) < 900;
    s_ = two_sum(1, -law.b), rate_ = value(rate);
    const DoubleDouble depth = value(D / Scaled(body.R)), z = depth * depth, square = DoubleDouble(1) - z;
    const double A = std::sqrt(std::max(0.0, square.hi));
    if (refine_ && s_.hi > 0 && A > shallowest_A) {
      const DoubleDouble root = DoubleDouble(A) + (square - two_product(A, A)) / (2 * A);
      stop_ = (mean_arm(s_, law.b, z, root) + body.K) / (s_ * two_sum(body.K, 1) * rate_);
      stop_time_ = stop_.lo > 0 ? std::nextafter(stop_.hi, infinity) : stop_.hi;
    }
  }
  seek(0);
}

void ExactForm::seek(double t) {
  t_ = t;
  const DoubleDouble rest = std::isinf(stop_.hi) ? stop_ : stop_ - t;
  const double lambda = trajectory_.log_ratio(t, rest.hi);
  lambda_ = refine_ && lambda > 0 && lambda < gone ? refined(lambda, rest) : lambda;
}

DoubleDouble ExactForm::refined(double lambda, DoubleDouble rest) const {
  const SpeedIntegrals& integrals = trajectory_.integrals();
  DoubleDouble next;
  if (rest.hi < t_) {
    next = -quick_log(s_ * (rate_ * rest + integrals.lag_rest(lambda))) / s_;
  } else {
    const DoubleDouble time = rate_ * t_ + integrals.lag(lambda), sum = -(s_ * time);
    next = std::abs(sum.hi) < 0x1p-7 ? time * log1p_ratio(sum) : -quick_log(DoubleDouble(1) + sum) / s_;
  }
  return DoubleDouble(lambda) + (next - lambda).hi / integrals.f(lambda);
}

double ExactForm::velocity() { return lambda_.hi < gone ? times_exp(speed_, -lambda_) : 0; }

}  // namespace rolling
