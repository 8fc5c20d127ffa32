#include "motion/speed_panel.h"

#include <utility>

#include "motion/gauss_legendre.h"
#include "motion/increasing_root.h"

namespace rolling {

/// Calls integrand(u, A, dq) at the nodes between 0 and y. dq is e^(-s u) dA / (b z) times the
/// weight of the node, so that e^(-s u) du is A dq.
template <typename Integrand>
void SpeedPanel::quadrature(double y, Integrand&& integrand) const {
  if (y == 0) return;
  const double b = arm_.b, s = 1 - b;
  const double w_end = -std::expm1(-2 * b * y);  // w = 1 - z/z_, so that A^2 = A_^2 + z_ w
  const double slope = 1 / (A_ + std::sqrt(std::max(0.0, A_ * A_ + z_ * w_end)));
  for (const auto& [x, weight] : gauss_legendre) {
    const double dA = slope * z_ * w_end * (1 + x) / 2, A = A_ + dA,
                 w = slope * w_end * (1 + x) / 2 * (A + A_);
    const double u = -std::log1p(-w) / (2 * b);
    integrand(u, A, weight / 2 * slope * (w_end / b) / (1 - w) * std::exp(-s * u));
  }
}

double SpeedPanel::time(double y) const {
  double sum = 0;
  quadrature(y,
             [&, K = arm_.K](double, double A, double dq) { sum += (K + A) / (K + 1) * A * dq; });
  return sum;
}

double SpeedPanel::lag(double y) const {
  double sum = 0;
  quadrature(y,
             [&, K = arm_.K](double, double A, double dq) { sum += (1 - A) / (K + 1) * A * dq; });
  return sum;
}

double SpeedPanel::distance(double y) const {
  double sum = 0;
  quadrature(y, [&, K = arm_.K](double u, double A, double dq) {
    sum += (K + A) / (K + 1) * A * std::exp(-u) * dq;
  });
  return sum;
}

SpeedGradient SpeedPanel::gradient(double y, Wanted wanted) const {
  SpeedGradient sum;
  const bool way = wanted == Wanted::speed_and_distance;
  if (way) sum.distance = distance(y);
  quadrature(y, [&, K = arm_.K](double u, double A, double dq) {
    const double h = (K * A + 1) / (K + 1) * dq;
    sum.h0 += h, sum.h1 += u * h;
    if (!way) return;
    const double ahead = -std::exp(-u) * std::expm1(u - y);  // e^-u - e^-y
    sum.g0 += ahead * h, sum.g1 += u * ahead * h;
  });
  return sum;
}

double SpeedPanel::lambda(double time, double /*rest*/) const {
  const double start = width_ * std::clamp(time / this->time(width_), 0.0, 1.0);
  return increasing_root(0, width_, start, [&](double y) {
    return std::pair(this->time(y) - time, arm_.f(from_ + y) * std::exp((arm_.b - 1) * y));
  });
}

}  // namespace rolling
