// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/ledger.h"

#include <cmath>

#include "base/error.h"
#include "unit/motion/closed_roll.h"
#include "unit/catch.h"
#include "unit/exact_body.h"

using namespace rolling;

TEST_CASE(
    "the balance of a roll under a constant shift closes exactly: v falls on a line, the outflow "
    "too",
    "[contact]") {
  // A = 1, D constant: v = v0 - g D t / ((K + 1) R), P = D v m g / R, whose trapezoids are exact.
  const Body body{1.375, 0.04, 0.83};
  const double D = 5.75e-4, v0 = 0.5, deceleration = body.g * D / ((body.K + 1) * body.R),
               stop = v0 / deceleration;
  Balance balance(body, true);
  for (int i = 0; i <= 37; ++i) {
    const double t = stop * i / 37;
    balance.push(t, Ledger(body, v0 - deceleration * t, D));
  }
  CHECK(std::abs(balance.energy.start() - 0.5 * (body.K + 1) * body.m * v0 * v0) <= 1e-15);
  CHECK(std::abs(balance.energy.to_mat() - balance.energy.start()) <= 1e-14);
  CHECK(std::abs(balance.energy.closure()) <= 1e-13);
  CHECK(balance.energy.imbalance() <= 1e-13);
}

TEST_CASE("a shift that is a tenth too large leaves a closure of a tenth", "[contact]") {
  const Body body{2, 0.1, 0.5};
  const double D = 1e-3, deceleration = body.g * D / (1.5 * body.R);
  Balance balance(body, true);
  for (int i = 0; i <= 10; ++i)
    balance.push(0.1 * i, Ledger(body, 1 - deceleration * 0.1 * i, 1.1 * D));
  CHECK(std::abs(balance.energy.closure() - 0.1) <= 1e-12);
  CHECK(std::abs(balance.energy.imbalance() - 0.1) <= 1e-12);
  CHECK(balance.energy.time_of_imbalance() == 1);
}

TEST_CASE("in the exact geometry the loss of a constant shift is its force's own", "[contact]") {
  // (K + 1) m v dv/dt = -(I_E1 + I_E2) with dv/dt = -g D / ((K + A) R)  (Eqs. 12, 22)
  const Body body{1, 0.04, 0.5};
  const double D = 0.03, A = std::sqrt(1 - D * D / (body.R * body.R)),
               deceleration = body.g * D / ((body.K + A) * body.R);
  Balance balance(body, true);
  for (int i = 0; i <= 4; ++i)
    balance.push(0.01 * i, Ledger(exact_body(body), 1 - deceleration * 0.01 * i, D));
  CHECK(std::abs(balance.energy.closure()) <= 1e-12);
}

TEST_CASE("a run whose energy does not change has no closure", "[contact]") {
  const Body body{1, 0.04, 0.5};
  Balance balance(body, true);
  const Ledger now(body, 0.5, 1e-3);
  balance.push(0, now);
  CHECK(std::isnan(balance.energy.closure()));
  balance.push(1, now);
  CHECK(std::isnan(balance.energy.closure()));
}

TEST_CASE("on a slope the work of gravity is an entry of the balance", "[contact]") {
  // A constant shift, uphill and downhill: v falls on a line (Eq. 12), and what is missing at the
  // end went into the mat and into the height that the body has gained, m g sin theta (x - x0).
  for (const bool is_exact : {false, true})
    for (const double slope : {0.05, -0.003}) {
      const Body body{1.375, 0.04, 0.83, 9.81, slope};
      const double D = 1e-3, a = acceleration_from_shift(exact_body(body, is_exact), D), v0 = 0.5,
                   T = 0.7;
      Balance balance(body, true);
      for (int i = 0; i <= 7; ++i)
        balance.push(T * i / 7, Ledger(exact_body(body, is_exact), v0 + a * T * i / 7, D));
      const double x = v0 * T + a * T * T / 2,
                   height = body.m * body.g * std::sin(std::atan(slope)) * x;
      CHECK(std::abs(balance.energy.to_gravity() - height) <= 1e-14);
      CHECK(std::abs(balance.energy.closure()) <= 1e-12);
      CHECK(balance.energy.imbalance() <= 1e-12);
      // Whoever does not know of the slope finds that it does not close.
      const Body level{1.375, 0.04, 0.83};
      Balance untold(level, true);
      for (int i = 0; i <= 7; ++i)
        untold.push(T * i / 7, Ledger(exact_body(level, is_exact), v0 + a * T * i / 7, D));
      CHECK(std::abs(untold.energy.closure()) > 0.05);
    }
}

TEST_CASE("an exponent that is wrong meets the closure and not the balance at every moment",
          "[contact]") {
  // The coefficient of b = 0 that dissipates as much as the true law over the whole run.
  const Body body{1.375, 0.04, 0.5};
  const auto roll_owned = closed_roll(body, {1.87e-3, 0.215}, 0.5, 0);
  Motion& roll = *roll_owned;
  Balance balance(body, true);
  for (int i = 0; i <= 240; ++i) {
    const double t = i == 240 ? roll.stop_time() : 0.01 * i;
    roll.seek(t);
    balance.push(t, Ledger(body, roll.velocity(), 1.4378938594202331e-3));
  }
  CHECK(std::abs(balance.energy.closure()) < 1e-5);
  CHECK(std::abs(balance.energy.imbalance() - 0.0418) < 2e-4);
  CHECK(std::abs(balance.energy.time_of_imbalance() - 0.82) < 0.015);
}

TEST_CASE("a right law does not fail by the quadrature", "[contact]") {
  // Up to 0.1 s between rows, for any exponent from 0 to 1, in the middle of a run and at the
  // stop.
  const Body body{1.375, 0.04, 0.5};
  for (const double b : {0.0, 0.0244, 0.215, 0.5, 0.8})
    for (const double dt : {0.01, 0.04, 0.1}) {
      const auto roll_owned = closed_roll(body, {1.87e-3, b}, 0.5, 0);
      Motion& roll = *roll_owned;
      Balance balance(body, true);
      const double T = std::min(roll.stop_time(), 6.0);
      for (int i = 0; i * dt < T; ++i) {
        roll.seek(i * dt);
        balance.push(i * dt, Ledger(body, roll.velocity(), roll.shift()));
      }
      roll.seek(T);
      balance.push(T, Ledger(body, roll.velocity(), roll.shift()));
      CAPTURE(b, dt, balance.energy.closure());
      CHECK(balance.energy.imbalance() < 0.012 * dt * dt);  // the trapezoidal rule has 0.05 dt^2
      CHECK(std::abs(balance.p.closure()) < 0.1 * dt * dt);
      CHECK(std::abs(balance.L.closure()) < 0.1 * dt * dt);
    }
}

TEST_CASE("momentum and angular momentum balance by Newton and Euler", "[contact]") {
  // D constant, so that all forces are: what flows in by each of them is the force times the time.
  for (const bool is_exact : {false, true})
    for (const double slope : {0.0, 0.05, -0.003}) {
      const Body body{1.375, 0.04, 0.83, 9.81, slope};
      const double D = 0.01, v0 = 0.5, T = 0.2;
      const double a = acceleration_from_shift(exact_body(body, is_exact), D);
      Balance balance(body, true);
      for (int i = 0; i <= 7; ++i)
        balance.push(T * i / 7, Ledger(exact_body(body, is_exact), v0 + a * T * i / 7, D));
      const double theta = std::atan(slope);
      const double A = is_exact ? std::sqrt(1 - D * D / (body.R * body.R)) : 1;
      const double F_N = body.m * body.g * std::cos(theta);
      const double F_H = body.m * (a + body.g * std::sin(theta));  // Newton, Eq. 4
      INFO(slope);
      CHECK(std::abs(balance.p.to_mat() + F_H * T) <= 1e-14);
      CHECK(std::abs(balance.p.to_gravity() - body.m * body.g * std::sin(theta) * T) <= 1e-14);
      CHECK(std::abs(balance.L_H() + A * body.R * F_H * T) <= 1e-15);
      CHECK(std::abs(balance.L_N() + D * F_N * T) <= 1e-15);
      // Euler, Eq. 5: the torques change K m R v.
      CHECK(std::abs(balance.L_H() + balance.L_N() - body.K * body.m * body.R * a * T) <= 1e-15);
      CHECK(std::abs(balance.p.closure()) <= 1e-12);
      CHECK(std::abs(balance.L.closure()) <= 1e-12);
    }
}

TEST_CASE("an error of the first speed counts once in the momenta, and twice in the energy",
          "[contact]") {
  const Body body{1, 0.04, 0.5};
  const double D = 1e-3, a = acceleration_from_shift(body, D), off = 1e-3;
  Balance balance(body, true);
  for (int i = 0; i <= 1000; ++i) {
    const double v = a * (0.001 * i - 1);
    const double read = i == 0 ? v * (1 + off) : v;
    balance.push(0.001 * i, Ledger(body, read, D));
  }
  CHECK(std::abs(balance.p.closure() + off) < 2e-6);
  CHECK(std::abs(balance.L.closure() + off) < 2e-6);
  CHECK(std::abs(balance.energy.closure() + 2 * off) < 5e-6);
}

TEST_CASE("a body without angular momentum has no closure of it", "[contact]") {
  const Body cart{1, 0.04, 0};
  Balance balance(cart, true);
  for (int i = 0; i <= 4; ++i) balance.push(i, Ledger(cart, 1 - 0.1 * i, 1e-3));
  CHECK(std::isnan(balance.L.closure()));
  CHECK(!std::isnan(balance.p.closure()));
}

TEST_CASE("a closure tells if a tenth of the largest store is missing", "[contact]") {
  for (const double end : {0.89, 0.91, -0.95}) {
    Account account;
    account.push(0, 1, 0, 0);
    account.push(1, end, 0, 0);
    CHECK(account.closure_tells() == (end < 0.9));
  }
}
