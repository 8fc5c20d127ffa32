#include "contact/balance.h"

#include <cmath>

#include "base/error.h"
#include "unit/catch.h"

using namespace rolling;

TEST_CASE(
    "the balance of a roll under a constant shift closes exactly: v falls on a line, the outflow "
    "too",
    "[rolling]") {
  // A = 1, D constant: v = v0 - g D t / ((K + 1) R), P = D v m g / R, whose trapezoids are exact.
  const Body body{1.375, 0.04, 0.83};
  const double D = 5.75e-4, v0 = 0.5, deceleration = body.g * D / ((body.K + 1) * body.R),
               stop = v0 / deceleration;
  Balance balance(body, Geometry::approximate);
  for (int i = 0; i <= 37; ++i) {
    const double t = stop * i / 37;
    balance.push(t, v0 - deceleration * t, D);
  }
  CHECK(std::abs(balance.start() - 0.5 * (body.K + 1) * body.m * v0 * v0) <= 1e-15);
  CHECK(std::abs(balance.dissipated() - balance.start()) <= 1e-14);
  CHECK(std::abs(balance.closure()) <= 1e-13);
}

TEST_CASE("a shift that is a tenth too large leaves a closure of a tenth", "[rolling]") {
  const Body body{2, 0.1, 0.5};
  const double D = 1e-3, deceleration = body.g * D / (1.5 * body.R);
  Balance balance(body, Geometry::approximate);
  for (int i = 0; i <= 10; ++i) balance.push(0.1 * i, 1 - deceleration * 0.1 * i, 1.1 * D);
  CHECK(std::abs(balance.closure() - 0.1) <= 1e-12);
}

TEST_CASE("in the exact geometry the loss of a constant shift is its force's own", "[rolling]") {
  // (K + 1) m v dv/dt = -(I_E1 + I_E2) with dv/dt = -g D / ((K + A) R)  (Eqs. 12, 22)
  const Body body{1, 0.04, 0.5};
  const double D = 0.03, A = std::sqrt(1 - D * D / (body.R * body.R)),
               deceleration = body.g * D / ((body.K + A) * body.R);
  Balance balance(body, Geometry::exact);
  for (int i = 0; i <= 4; ++i) balance.push(0.01 * i, 1 - deceleration * 0.01 * i, D);
  CHECK(std::abs(balance.closure()) <= 1e-12);
}

TEST_CASE("a run whose energy does not change has no closure", "[rolling]") {
  const Body body{1, 0.04, 0.5};
  Balance balance(body, Geometry::approximate);
  balance.push(0, 0.5, 1e-3);
  CHECK_THROWS_AS(balance.closure(), Error);
  balance.push(1, 0.5, 1e-3);
  CHECK_THROWS_AS(balance.closure(), Error);
}
