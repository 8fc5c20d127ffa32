// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "contact/road.h"

namespace rolling {

Incline incline(const Body& c, double x, double v) {
  if (!c.road) return incline(c);
  c.road->check(x);
  const Road::Place place = c.road->at(x);
  const double sin = c.steepness * place.h1 + c.slope;
  const double cos = std::sqrt(1 - sin * sin);
  const double all = cos + c.steepness * place.h2 / cos * v * v / c.g;
  if (!(all > 0)) fail("the body leaves the track at x = {:.6g} m, v = {:.6g} m/s", x, v);
  return {all, sin / all};
}

Body seen_along(Body body, double way) {
  body.slope *= way;
  body.wind *= way;
  if (way < 0 && body.road) body.road = body.road->mirrored();
  return body;
}

void check_shift(const Body& c, double D) {
  if (!(std::abs(D) <= c.R)) fail("the shift D = {:.6g} m is beyond the radius {:.6g} m", D, c.R);
}

double arm_factor(const Body& c, double D) {
  if (!c.exact) return 1;
  D = std::abs(D);
  return std::sqrt((c.R - D) / c.R * (1 + D / c.R));  // R - D is exact where D is near R
}

// Below 0 - x stands for -x: for x = 0 the result is then +0, and no table shows "-0".

Acceleration accelerate(const Body& c, double D, const Incline& incline) {
  const auto [cos, tan] = incline;
  const double A = c.exact && std::abs(D) >= c.R ? 0 : arm_factor(c, D);
  const double A_D = c.exact && A > 0 ? -D / (c.R * c.R * A) : 0;
  const double arm = (c.K + A) * c.R;
  const double a = 0 - c.g * (D + A * c.R * tan) * cos / arm;
  const double by_D = -(c.g * cos * (1 + A_D * c.R * tan) + a * A_D * c.R) / arm;
  return {a, by_D, -c.g * D / arm, -c.g * A * c.R / arm};
}

double acceleration_from_shift(const Body& c, double D) {
  check_shift(c, D);
  return accelerate(c, D).a;
}

double shift_from_acceleration(const Body& c, double a) {
  const double cos = incline(c).cos;
  const double sin = incline(c).sin();
  const double K = c.K;
  const double s = 0 - a / c.g;
  if (!c.exact) return ((1 + K) * c.R * s - c.R * sin) / cos;
  // Eq. 12 is s (K + A) = cos D/R + sin A with s = -a/g. At |D| = R, where A = 0, this is
  // K |s| = cos. For larger |s| the root below belongs to A < 0, and its |D| is less than R again,
  // so a test of |D| would not detect it; on a steep slope, tan > 1/K, two roots may have A > 0.
  // The margin accepts the rounded acceleration of D = R.
  constexpr double eps = std::numeric_limits<double>::epsilon();
  if (!(K * std::abs(s) <= (1 + 4 * eps) * cos))
    fail(
        "the acceleration {:.6g} m/s^2 determines no shift D within the radius {:.6g} m: the "
        "largest that does is {:.6g} m/s^2",
        a, c.R, c.g * cos / K);
  // s^2 may overflow, which needs a K close to 0.
  if (K * std::abs(s) >= cos || std::abs(s) > 1e100) return std::copysign(c.R, s);
  // Squared, K s - cos D/R = A (sin - s) is quadratic in D/R, and A >= 0 chooses its root.
  const double q = s - sin;
  const double h2 = cos * cos + q * q;
  const double d = (K * s * cos + q * std::sqrt(cos * cos + (q - K * s) * (q + K * s))) / h2;
  return c.R * std::clamp(d, -1.0, 1.0);
}

}  // namespace rolling
