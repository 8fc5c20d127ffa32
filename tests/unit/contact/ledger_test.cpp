#include "contact/ledger.h"

#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"
#include "motion/closed_form.h"
#include "contact/contact.h"
#include "motion/exact_form.h"
#include "unit/catch.h"

using namespace rolling;

TEST_CASE("ledger: every entry agrees with the forces (Eqs. 14 to 22)", "[rolling]") {
  std::mt19937_64 random(3);
  const auto between = [&](double lo, double hi) {
    return std::uniform_real_distribution(lo, hi)(random);
  };
  for (int i = 0; i < 2000; ++i) {
    const Body c{between(0.01, 5), between(1e-3, 2), between(0, 1), between(1, 25)};
    const double v = between(-3, 3), D = c.R * between(-1, 1);
    for (const Geometry geometry : {Geometry::approximate, Geometry::exact}) {
      const Ledger e = ledger(c, geometry, v, D);
      const double F_H = horizontal_force(c, geometry, D), omega = v / c.R,
                   a = acceleration_from_shift(c, geometry, D);
      const double scale = std::abs(v * c.m * c.g) + std::abs(v * F_H);
      const auto close = [&](double x, double y) {
        return std::abs(x - y) <= 8 * std::numeric_limits<double>::epsilon() * scale;
      };
      REQUIRE(std::abs(e.E_trans - 0.5 * c.m * v * v) <= 1e-15 * e.E_trans);
      REQUIRE(std::abs(e.E_rot - 0.5 * c.K * c.m * c.R * c.R * omega * omega) <= 4e-15 * e.E_trans);
      // The force moves with P: v(P)_H = (1 - A) v (Eq. 16), v(P)_V = -(D/R) v (Eq. 20).
      const double A = arm_factor(c, geometry, D);
      REQUIRE(close(e.I_E1, -(1 - A) * v * F_H));                                  // Eq. 17
      REQUIRE(close(e.I_E2, D / c.R * v * c.m * c.g));                             // Eq. 21
      REQUIRE(close(e.P_T1, omega * torque_of_horizontal_force(c, geometry, D)));  // Eq. 18
      REQUIRE(close(e.P_R2, -omega * torque_of_normal_force(c, D)));               // Eq. 19
      REQUIRE(close(e.P_R1, -e.P_T1));
      REQUIRE(close(e.P_T2, -e.P_R2));
      REQUIRE(e.P_diss == e.I_E1 + e.I_E2);
      // What is stored changes by what flows: translation, rotation, and both together (Eq. 22).
      REQUIRE(close(c.m * v * a, -e.P_T1 - e.I_E1));
      REQUIRE(close(c.K * c.m * v * a, -e.P_R1 - e.P_R2));
      REQUIRE(close(e.P_diss, -(c.K + 1) * c.m * v * a));
    }
  }
}

TEST_CASE("ledger: over a whole run the outflow is the energy of the start (Eq. 23)", "[rolling]") {
  // Simpson's rule in r, t = T (1 - r^4): the power falls like a power of T - t.
  const auto whole = [](Motion& motion, const Body& body, Geometry geometry) {
    const int n = 4000;
    const double T = motion.stop_time();
    double sum = 0;
    for (int i = 0; i <= n; ++i) {
      const double r = 1 - static_cast<double>(i) / n;
      motion.seek(T * (1 - r * r * r * r));
      sum += (i == 0 || i == n ? 1
              : i % 2          ? 4
                               : 2) *
             ledger(body, geometry, motion.velocity(), motion.shift()).P_diss * 4 * r * r * r;
    }
    return T * sum / (3 * n);
  };
  for (const double K : {0.5, 0.83}) {
    const Body body{1.375, 0.04, K};
    const double energy = 0.5 * (K + 1) * body.m * 0.25;
    ClosedForm closed(body, {1.87e-3, 0.215}, 0.5, 0);
    CHECK(std::abs(whole(closed, body, Geometry::approximate) / energy - 1) < 1e-9);
    ExactForm exact(body, {0.03, 0.215}, 0.5, 0);
    CHECK(std::abs(whole(exact, body, Geometry::exact) / energy - 1) < 1e-9);
    CHECK(std::abs(whole(exact, body, Geometry::approximate) / energy - 1) >
          1e-3);  // it does see the geometry
  }
}

TEST_CASE("ledger: rolling backwards the mat gives energy back, and rest has no signs",
          "[rolling]") {
  const Body body{1.375, 0.04, 0.5};
  CHECK(ledger(body, Geometry::exact, -0.01, 1e-3).P_diss < 0);
  const Ledger rest = ledger(body, Geometry::exact, 0, 0);
  for (const double entry : {rest.E_trans, rest.E_rot, rest.I_E1, rest.I_E2, rest.P_T1, rest.P_R1,
                             rest.P_R2, rest.P_T2, rest.P_diss}) {
    CHECK(entry == 0);
    CHECK_FALSE(std::signbit(entry));
  }
  CHECK_THROWS_AS(ledger(body, Geometry::approximate, 0.5, 0.05), Error);
}
