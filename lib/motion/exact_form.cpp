#include "motion/exact_form.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rolling {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double smallest_arm = 0x1p-10;  // least root of the continued fraction: 16/root steps
constexpr double gone = 1e4;              // for lambda above it, v = 0 in a double
constexpr double least_f =
    0.01;  // below it (K near 0, D near R) the lag is nearly all, and 1 - lag loses digits

/// int_0^inf A e^(-u) du, A = sqrt(1 - z e^(-u/p)), for z = 1 - root^2: F(-1/2, p; p+1; z) = p z^-p
/// B_z(p, 3/2), p = s/(2b).
///
/// The method is the continued fraction of the incomplete beta function (DLMF 8.17.22) with its
/// terms multiplied by 2b, evaluated from the end. A step reduces the error by the factor (1 -
/// root)/(1 + root).
DoubleDouble mean_arm_fraction(DoubleDouble s, double b, DoubleDouble root) {
  const DoubleDouble z = -(root * root) + 1;
  DoubleDouble fraction = 1;
  for (double m = std::ceil(16 / std::atanh(std::min(root.hi, 0.999))) + 5; m >= 0; --m) {
    const DoubleDouble bm = two_product(2 * m, b), at = s + bm * 2;
    fraction = DoubleDouble(1) -
               (s + bm) * (s + bm + two_product(3, b)) * z / (at * (at + 2 * b) * fraction);
    if (m > 0)
      fraction =
          DoubleDouble(1) + bm * (two_product(3, b) - bm) * z / ((at - 2 * b) * at * fraction);
  }
  return root * root * root / fraction;
}

/// The same for small roots: the continued fraction at a larger root, p root^2 <= 1, and a power
/// series in A between the two roots:
///   z^p F = z1^p F1 + 2p int_root^root1 (1 - A^2)^(p-1) A^2 dA.
DoubleDouble mean_arm_series(DoubleDouble s, double b, DoubleDouble root, double larger) {
  const DoubleDouble p = s / two_product(2, b), square = root * root,
                     larger_square = two_product(larger, larger);
  DoubleDouble coefficient = 1, power = square * root, larger_power = larger_square * larger,
               sum = 0;
  for (double n = 0; std::abs(coefficient.hi) * larger_power.hi > 1e-35 * larger_square.hi * larger;
       ++n) {
    sum = sum + coefficient * (larger_power - power) / (2 * n + 3);
    coefficient = coefficient * (DoubleDouble(n + 1) - p) / (n + 1);
    power = power * square, larger_power = larger_power * larger_square;
  }
  const DoubleDouble log_z = log(-square + 1), log_z1 = log(-larger_square + 1);
  return exp(p * (log_z1 - log_z)) * mean_arm_fraction(s, b, larger) +
         exp(-(p * log_z)) * p * sum * 2;
}

}  // namespace

ExactForm::ExactForm(const Body& body, PowerLaw law, double v0, double x0)
    : trajectory_(body, Geometry::exact, law, v0), x0_(x0), stop_(trajectory_.stop_time()),
      stop_time_(stop_.hi), speed_(Scaled(v0)) {
  if (v0 > 0 && law.b >= 0) {
    const Scaled D = Scaled(law.a) * power(v0, law.b),
                 rate = D / (Scaled(two_sum(body.K, 1)) * Scaled(body.R) / Scaled(body.g)) /
                        Scaled(v0);
    refine_ = std::abs(rate.exponent) < 900;
    s_ = two_sum(1, -law.b), rate_ = rate.value();
    if (s_.hi != 0) minus_inverse_s_ = DoubleDouble(-1) / s_;
    const DoubleDouble depth = (D / Scaled(body.R)).value(), square = -(depth * depth) + 1;
    const double A = std::sqrt(std::max(0.0, square.hi)), p = s_.hi / (2 * law.b);
    const double border =
        p > 4 ? std::exp2(-std::ceil(std::log2(p) / 2)) : 0.5;  // a power of two, p border^2 <= 1
    if (refine_ && s_.hi > 0 && std::max(A, border) >= smallest_arm) {
      const DoubleDouble root =
          A > 0 ? DoubleDouble(A) + (square - two_product(A, A)) / (2 * A) : 0;
      stop_ = ((A < border ? mean_arm_series(s_, law.b, root, border)
                           : mean_arm_fraction(s_, law.b, root)) +
               body.K) /
              (s_ * two_sum(body.K, 1) * rate_);
      stop_time_ = stop_.lo > 0 ? std::nextafter(stop_.hi, infinity) : stop_.hi;
    }
  }
  seek(0);
}

void ExactForm::seek(double t) {
  t_ = t;
  const DoubleDouble rest = std::isinf(stop_.hi) ? stop_ : stop_ - t;
  const double lambda = trajectory_.log_ratio(t, rest.hi);
  lambda_ = refine_ && lambda > 0 && lambda < gone && trajectory_.integrals().f(lambda) > least_f
                ? refined(lambda, rest)
                : lambda;
}

DoubleDouble ExactForm::refined(double lambda, DoubleDouble rest) const {
  const SpeedIntegrals& integrals = trajectory_.integrals();
  DoubleDouble next;
  if (rest.hi < 2 * t_) {
    next = minus_inverse_s_ * quick_log(s_ * (rate_ * rest + integrals.lag_rest(lambda)));
  } else {
    const DoubleDouble time = rate_ * t_ + integrals.lag(lambda), sum = -(s_ * time);
    next =
        std::abs(sum.hi) < 0x1p-7 ? time * log1p_ratio(sum) : minus_inverse_s_ * quick_log(sum + 1);
  }
  return DoubleDouble(lambda) + (next - lambda).hi / integrals.f(lambda);
}

double ExactForm::velocity() { return lambda_.hi < gone ? times_exp(speed_, -lambda_) : 0; }

}  // namespace rolling
