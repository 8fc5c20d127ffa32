// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/ledger.h"

#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"
#include "unit/motion/closed_roll.h"
#include "contact/contact.h"
#include "motion/scene.h"
#include "unit/catch.h"
#include "unit/exact_body.h"

using namespace rolling;

TEST_CASE("ledger: every quantity agrees with the forces (Eqs. 1 to 22), on slopes too",
          "[contact]") {
  std::mt19937_64 random(3);
  const auto between = [&](double lo, double hi) {
    return std::uniform_real_distribution(lo, hi)(random);
  };
  for (int i = 0; i < 4000; ++i) {
    const Body c{between(0.01, 5), between(1e-3, 2), between(0, 1), between(1, 25),
                 i % 3 == 0 ? 0 : between(-0.5, 0.5)};
    const double v = between(-3, 3), D = c.R * between(-1, 1), theta = std::atan(c.slope);
    for (const bool is_exact : {false, true}) {
      const Ledger e(exact_body(c, is_exact), v, D);
      const double a = acceleration_from_shift(exact_body(c, is_exact), D),
                   A = arm_factor(exact_body(c, is_exact), D),
                   force = c.m * c.g * (1 + 1 / (c.K + A));
      const auto close = [&](double x, double y, double scale) {
        return std::abs(x - y) <= 8 * std::numeric_limits<double>::epsilon() * scale;
      };
      REQUIRE(close(e.omega() * c.R, v, std::abs(v)));  // Eq. 1
      REQUIRE(close(e.p(), c.m * v, c.m * std::abs(v)));
      REQUIRE(close(e.L(), c.K * c.R * e.p(), std::abs(e.L())));  // Eq. 3
      REQUIRE((e.A() == A && e.D() == D));
      // Newton's laws, along the mat and about the axis: Eqs. 4 to 7 and 9.
      REQUIRE(close(e.F_N(), c.m * c.g * std::cos(theta), force));
      REQUIRE(close(e.F_H() - c.m * c.g * std::sin(theta), c.m * a, force));
      REQUIRE(close(e.tau_H(), -A * c.R * e.F_H(), force * c.R));
      REQUIRE(close(e.tau_N(), -D * e.F_N(), force * c.R));
      REQUIRE(close(e.tau_N() + e.tau_H(), c.K * c.m * c.R * a, force * c.R));
      if (c.slope == 0)
        REQUIRE(close(e.tau_N() * A, -(c.K + A) * e.tau_H(), 2 * force * c.R));  // Eq. 10
      // The force moves with P, and what it takes at that speed leaves the body: Eqs. 16 to 21.
      const double power = force * std::abs(v);
      REQUIRE(close(e.vP_H(), (1 - A) * v, std::abs(v)));
      REQUIRE(close(e.vP_V(), -D * e.omega(), std::abs(v)));
      REQUIRE(close(e.I_E1(), -(1 - A) * v * e.F_H(), power));
      REQUIRE(close(e.I_E2(), D / c.R * v * e.F_N(), power));
      REQUIRE(close(e.P_T1(), -A * v * e.F_H(), power));
      REQUIRE(close(e.P_R2(), v / c.R * D * e.F_N(), power));
      REQUIRE((e.P_R1() == -e.P_T1() && e.P_T2() == -e.P_R2()));
      REQUIRE((e.P_T3() == e.I_E1() && e.P_T4() == e.I_E2()));
      REQUIRE(e.P_diss() == e.P_T3() + e.P_T4());
      // What is stored changes by what flows: translation, rotation, and both together (Eq. 22).
      REQUIRE(close(e.E_trans(), 0.5 * e.p() * v, e.E_trans()));
      REQUIRE(close(e.E_rot(), 0.5 * e.L() * e.omega(), e.E_rot()));
      REQUIRE(close(c.m * v * a, -e.P_T1() - e.I_E1() - e.P_g(), power));
      REQUIRE(close(c.K * c.m * v * a, -e.P_R1() - e.P_R2(), power));
      REQUIRE(close(-(c.K + 1) * c.m * v * a, e.P_diss() + e.P_g(), 2 * power));
    }
  }
}

TEST_CASE("ledger: over a whole run the outflow is the energy of the start (Eq. 23)", "[contact]") {
  // Simpson's rule in r, t = T (1 - r^4): the power falls like a power of T - t.
  const auto whole = [](Motion& motion, const Body& c) {
    const int n = 4000;
    const double T = motion.stop_time();
    double sum = 0;
    for (int i = 0; i <= n; ++i) {
      const double r = 1 - static_cast<double>(i) / n;
      motion.seek(T * (1 - r * r * r * r));
      sum += (i == 0 || i == n ? 1
              : i % 2          ? 4
                               : 2) *
             Ledger(c, motion.velocity(), motion.shift()).P_diss() * 4 * r * r * r;
    }
    return T * sum / (3 * n);
  };
  for (const double K : {0.5, 0.83}) {
    const Body body{1.375, 0.04, K};
    const double energy = 0.5 * (K + 1) * body.m * 0.25;
    const auto closed_owned = closed_roll(body, {1.87e-3, 0.215}, 0.5, 0);
    Motion& closed = *closed_owned;
    CHECK(std::abs(whole(closed, body) / energy - 1) < 1e-9);
    const auto exact =
        start({exact_body(body), PowerLaw{0.03, 0.215}, {0}, 0.5, 0}, {Method::exact}, 0);
    CHECK(std::abs(whole(*exact, exact_body(body)) / energy - 1) < 1e-9);
    CHECK(std::abs(whole(*exact, body) / energy - 1) > 1e-3);  // it does see the geometry
  }
}

TEST_CASE("ledger: rolling backwards the mat gives energy back, and rest has no signs",
          "[contact]") {
  const Body body{1.375, 0.04, 0.5};
  CHECK(Ledger(exact_body(body), -0.01, 1e-3).P_diss() < 0);
  for (const double D : {0.0, 1e-3}) {
    const Ledger rest(exact_body(body), 0, D);
    for (const double entry : {rest.omega(), rest.p(), rest.L(), rest.vP_H(), rest.vP_V(),
                               rest.E_trans(), rest.E_rot(), rest.I_E1(), rest.I_E2(), rest.P_T1(),
                               rest.P_R1(), rest.P_R2(), rest.P_T2(), rest.P_diss(), rest.P_g()}) {
      CHECK(entry == 0);
      CHECK_FALSE(std::signbit(entry));
    }
  }
  const Ledger level(exact_body(body), 0.5, 0);
  for (const double force : {level.F_H(), level.tau_N(), level.tau_H()})
    CHECK((force == 0 && !std::signbit(force)));
  const Body ring{1.375, 0.04, 0};
  const Ledger back(ring, -0.5, 1e-3);
  for (const double entry : {back.L(), back.vP_H(), back.E_rot(), back.I_E1()})
    CHECK((entry == 0 && !std::signbit(entry)));
}

TEST_CASE("ledger: a shift beyond the radius has a meaning only where A = 1", "[contact]") {
  const Body body{1.375, 0.04, 0.5};
  CHECK_THROWS_AS(Ledger(exact_body(body), 0.5, 0.05), Error);
  CHECK(std::abs(Ledger(body, 0.5, 0.05).P_diss() - 1.25 * 0.5 * 1.375 * 9.81) < 1e-13);
}
