#include "motion/speed_series.h"

#include <limits>
#include <utility>

#include "motion/increasing_root.h"
#include "motion/power_integral.h"

namespace rolling {

namespace {

constexpr double least_term = 1e-18;  // relative to the sum of the series, which is close to 1

/// int_0^lambda e^(-s y) dy = time, solved for lambda; rest is 1/s - time for s > 0.
double power_integral_inverse(double s, double time, double rest) {
  if (s > 0 && rest < time) return -std::log(s * rest) / s;
  return s == 0 ? time : -std::log1p(-s * time) / s;
}

}  // namespace

SpeedSeries SpeedSeries::constant(const SpeedArm& arm) {
  SpeedSeries series(arm, 0);
  const double f = arm.f(0);
  series.terms_ = {{1 - arm.b, f, 1 - f, (arm.K + 1 / arm.A(0)) / (arm.K + 1)}};
  return series;
}

SpeedSeries SpeedSeries::binomial(const SpeedArm& arm, double from) {
  SpeedSeries series(arm, from);
  const double s = 1 - arm.b, z = arm.z(from);
  series.terms_ = {{s, 1, 0, 1}};
  double c = 1;  // binom(2n, n) (z/4)^n: 1/A is the sum of c, A that of -c / (2n - 1)
  for (int n = 1; (c *= z * (2 * n - 1) / (2 * n)) > least_term; ++n) {
    const double f = -c / ((2 * n - 1) * (arm.K + 1));
    series.terms_.push_back({s + 2 * arm.b * n, f, -f, c / (arm.K + 1)});
  }
  return series;
}

double SpeedSeries::time(double y) const {
  double sum = 0;
  for (const Term& term : terms_) sum += term.f * power_integral(term.s, y);
  return sum;
}

double SpeedSeries::lag(double y) const {
  double sum = 0;
  for (const Term& term : terms_)
    if (term.lag != 0) sum += term.lag * power_integral(term.s, y);
  return sum;
}

double SpeedSeries::lag_rest(double y) const {
  const double ratio = std::exp(-2 * arm_.b * y);
  double sum = terms_.back().lag_by_s;
  for (auto term = terms_.rbegin() + 1; term != terms_.rend(); ++term)
    sum = sum * ratio + term->lag_by_s;
  return sum * std::exp((arm_.b - 1) * y);
}

double SpeedSeries::distance(double y) const {
  double sum = 0;
  for (const Term& term : terms_) sum += term.f * power_integral(term.s + 1, y);
  return sum;
}

SpeedGradient SpeedSeries::gradient(double y, Wanted wanted) const {
  SpeedGradient sum;
  for (const Term& term : terms_) {
    const double integral = power_integral(term.s, y), moment = power_moment(term.s, y, integral);
    sum.h0 += term.h * integral, sum.h1 += term.h * moment;
    if (wanted == Wanted::speed) continue;
    const double next = power_integral(term.s + 1, y);
    const auto headway = headway_integrals(term.s, y, integral, moment, next);
    sum.distance += term.f * next;
    sum.g0 += term.h * headway.integral, sum.g1 += term.h * headway.moment;
  }
  return sum;
}

double SpeedSeries::lambda(double time, double rest) const {
  const double s = terms_.front().s, most = terms_.front().f;
  if (terms_.size() > 1 && s > 0 && rest < 2 * time) return lambda_of_rest(rest);
  const double start = power_integral_inverse(s, time / most, rest / most);
  if (terms_.size() == 1) return start;
  // f is smallest at the beginning and below 1 everywhere, which gives the bracket of the root.
  const double end =
      power_integral_inverse(s, time / arm_.f(from_), std::numeric_limits<double>::infinity());
  return increasing_root(start, end, start, [&](double y) {
    double value = -time;  // it comes first because the first term nearly cancels it
    for (const Term& term : terms_) value += term.f * power_integral(term.s, y);
    return std::pair(value, arm_.f(from_ + y) * std::exp(-s * y));
  });
}

/// rest = int_y^infinity f e^(-s u) du = e^(-s y) S(z) is nearly a power of the speed, so that its
/// logarithm is nearly linear in y. A Newton step needs two exponential functions, whereas time(y)
/// needs one for each term.
double SpeedSeries::lambda_of_rest(double rest) const {
  const double s = terms_.front().s;
  const auto inverse = [&](double f) { return std::max(0.0, std::log(f / (s * rest)) / s); };
  const double start = inverse(1);
  return increasing_root(inverse(arm_.f(from_)), start, start, [&](double y) {
    const double ratio = std::exp(-2 * arm_.b * y);
    double S = 0, f = 0;
    for (auto term = terms_.rbegin(); term != terms_.rend(); ++term)
      S = S * ratio + term->f_by_s, f = f * ratio + term->f;
    return std::pair(s * y - std::log(S / rest), f / S);
  });
}

}  // namespace rolling
