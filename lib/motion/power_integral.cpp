#include "motion/power_integral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace rolling {

// All of these integrals are divided differences of the exponential function (McCurdy, Ng, Parlett
// 1984, Math. Comp. 43, 501):
//   power_integral = l exp[0, -s l],   power_moment = l^2 exp[0, -s l, -s l],
//   headway: l^2 exp[0, -l, -(s+1) l]  and  l^3 exp[0, -l, -(s+1) l, -(s+1) l].
// The Taylor series exp[0, x_1 ... x_n] = sum_k h_k(x_1 ... x_n) / (n + k)!, with h_k the complete
// symmetric polynomials, contains no differences. It is used if the arguments are at most 1.

namespace {

constexpr std::size_t terms = 18;  // 1/20! < 2^-60

constexpr std::array<double, terms + 3> inverse_factorials() {
  std::array<double, terms + 3> c{1};
  double factorial = 1;  // exact up to 22!
  for (std::size_t k = 1; k < c.size(); ++k) {
    factorial *= static_cast<double>(k);
    c[k] = 1 / factorial;
  }
  return c;
}

constexpr auto inverse_factorial = inverse_factorials();

constexpr auto moment_coefficient = [] {
  std::array<double, terms> c{};
  for (std::size_t k = 0; k < terms; ++k)
    c[k] = static_cast<double>(k + 1) * inverse_factorial[k + 2];
  return c;
}();
static_assert(terms % 2 == 0);

}  // namespace

double power_integral(double s, double lambda) {
  return s == 0 ? lambda : -std::expm1(-s * lambda) / s;
}

namespace {

double power_moment_series(double s, double lambda) {
  const double x = s == 0 ? 0 : -s * lambda;
  double even = 0, odd = 0;  // terms of the sum of (k + 1) x^k / (k + 2)!: two chains that do not
                             // wait for one another
  for (std::size_t k = terms; k > 0; k -= 2) {
    even = even * (x * x) + moment_coefficient[k - 2];
    odd = odd * (x * x) + moment_coefficient[k - 1];
  }
  return lambda * lambda * (even + x * odd);
}

}  // namespace

double power_moment(double s, double lambda, double integral) {
  if (s == 0 || std::abs(s * lambda) <= 1) return power_moment_series(s, lambda);
  return power_moment(s, lambda, integral, std::exp(-s * lambda));
}

double power_moment(double s, double lambda, double integral, double decay) {
  if (s * lambda > 800) return 1 / (s * s);
  return s == 0 || std::abs(s * lambda) <= 0.25 ? power_moment_series(s, lambda)
                                                : (integral - lambda * decay) / s;
}

HeadwayIntegrals headway_integrals(double s, double lambda, double integral, double moment,
                                   double next) {
  const double x = -lambda, y = -(s + 1) * lambda;
  if (std::max(std::abs(x), std::abs(y)) <= 1) {
    double power = 1, h2 = 1, h3 = 1;  // x^k, h_k(x, y), h_k(x, y, y)
    double sum2 = inverse_factorial[2], sum3 = inverse_factorial[3];
    for (std::size_t k = 1; k < terms; ++k) {
      power *= x;
      h2 = y * h2 + power;
      h3 = y * h3 + h2;
      sum2 += h2 * inverse_factorial[k + 2];
      sum3 += h3 * inverse_factorial[k + 3];
    }
    return {lambda * lambda * sum2, lambda * lambda * lambda * sum3};
  }
  const double rho = std::exp(-lambda);
  const double next_moment = power_moment(s + 1, lambda, next);
  if (rho == 0) return {next, next_moment};
  return {next - rho * integral, next_moment - rho * moment};
}

}  // namespace rolling
