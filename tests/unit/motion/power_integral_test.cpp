#include "motion/power_integral.h"

#include <cmath>
#include <limits>

#include "unit/catch.h"

using namespace rolling;

namespace {

struct Reference {
  double s, lambda, integral, moment, headway, headway_moment;
};

const Reference references[] = {
#include "unit/motion/power_integral_reference.inc"
};

HeadwayIntegrals headway_of(double s, double lambda) {
  const double integral = power_integral(s, lambda);
  return headway_integrals(s, lambda, integral, power_moment(s, lambda, integral),
                           power_integral(s + 1, lambda));
}

constexpr double eps = std::numeric_limits<double>::epsilon(),
                 infinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("power integrals: high precision, s through 0 and -1, lambda from 1e-12 to 200",
          "[rolling]") {
  for (const Reference& r : references) {
    const double z = std::abs(r.s * r.lambda);
    const double tolerance =
        (8 + z) * eps;  // z: what the rounding of s lambda does to its exponential
    const auto headway = headway_of(r.s, r.lambda);
    INFO("s " << r.s << " lambda " << r.lambda);
    CHECK(std::abs(power_integral(r.s, r.lambda) - r.integral) <= tolerance * r.integral);
    CHECK(std::abs(power_moment(r.s, r.lambda, r.integral) - r.moment) <= tolerance * r.moment);
    CHECK(std::abs(power_moment(r.s, r.lambda, r.integral, std::exp(-r.s * r.lambda)) - r.moment) <=
          4 * tolerance * r.moment);
    // From lambda = 1 on, or where s is large, they are a difference.
    const double loss = std::abs(r.s + 1) * r.lambda <= 1 && r.lambda <= 1 ? 1 : 3 + 2 / r.lambda;
    CHECK(std::abs(headway.integral - r.headway) <= loss * tolerance * r.headway);
    CHECK(std::abs(headway.moment - r.headway_moment) <= loss * tolerance * r.headway_moment);
  }
}

TEST_CASE("power integrals: at rest, lambda infinite", "[rolling]") {
  CHECK(power_integral(0.25, infinity) == 4);
  CHECK(power_moment(0.25, infinity, 4) == 16);
  CHECK(headway_of(0.25, infinity).integral == 0.8);
  CHECK(power_integral(0, infinity) == infinity);
  CHECK(power_integral(-0.5, infinity) == infinity);
}
