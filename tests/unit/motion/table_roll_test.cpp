// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <utility>

#include "base/error.h"
#include "unit/motion/closed_roll.h"
#include "motion/roll.h"
#include "motion/scene.h"
#include "unit/catch.h"
#include "unit/exact_body.h"

using namespace rolling;

namespace {

const Body cylinder{1.375, 0.04, 0.5};

std::unique_ptr<Motion> rolled(const Body& body, Law law, double v0, double x0) {
  return start({body, std::move(law), {0}, v0, x0}, {Method::exact}, 0);
}

}  // namespace

TEST_CASE("Table: a constant shift is the closed form, and the exact one", "[rolling]") {
  for (const double a : {1e-3, 0.03}) {
    const TableLaw law({0.1, 0.3, 2}, {a, a, a});
    const auto approximate = rolled(cylinder, law, 0.5, 0.2),
               exact = rolled(exact_body(cylinder), law, 0.5, 0.2),
               same = rolled(exact_body(cylinder), PowerLaw{a, 0}, 0.5, 0.2);
    const auto closed_owned = closed_roll(cylinder, {a, 0}, 0.5, 0.2);
    Motion& closed = *closed_owned;
    for (const auto& [table, reference] :
         {std::pair<Motion*, Motion*>{approximate.get(), &closed}, {exact.get(), same.get()}}) {
      CHECK(std::abs(table->stop_time() / reference->stop_time() - 1) < 1e-14);
      for (const double part : {0.0, 1e-6, 0.1, 0.5, 0.77, 0.999, 1.1}) {
        table->seek(part * reference->stop_time());
        reference->seek(part * reference->stop_time());
        CHECK(std::abs(table->velocity() - reference->velocity()) < 1e-14);
        CHECK(std::abs(table->position() - reference->position()) < 1e-14);
        CHECK(std::abs(table->acceleration() - reference->acceleration()) < 1e-12);
      }
    }
  }
}

TEST_CASE("Table: D proportional to v + c has a logarithm for its time", "[rolling]") {
  // D = p + q v exactly: v' = -k (p + q v), so v + p/q decays exponentially.
  const double p = 2e-3, q = 4e-3, k = 9.81 / 0.06;
  const TableLaw law({0, 0.2, 0.5, 1}, {p, p + 0.2 * q, p + 0.5 * q, p + q});
  const auto motion = rolled(cylinder, law, 0.8, 0);
  const double stop = std::log1p(0.8 * q / p) / (k * q);
  CHECK(std::abs(motion->stop_time() / stop - 1) < 1e-14);
  for (int i = 1; i < 100; ++i) {
    const double t = stop * i / 100;
    motion->seek(t);
    CHECK(std::abs(motion->velocity() - ((0.8 + p / q) * std::exp(-k * q * t) - p / q)) < 1e-14);
    CHECK(std::abs(motion->position() -
                   (-(0.8 + p / q) * std::expm1(-k * q * t) / (k * q) - p / q * t)) < 1e-14);
  }
}

// The interpolated law loses as many digits at its least D as that is smaller than its neighbours.
TEST_CASE("Table: a law that nearly vanishes, against quadrature with 30 digits", "[rolling]") {
  const double references[][3] = {{1e-5, 14.493549327408447, 2.8069667462156344},
                                  {1e-6, 44.198229968571606, 8.7479028744482666},
                                  {1e-8, 431.57886328443814, 86.224029537621578}};
  for (const auto& [least, time, distance] : references) {
    const auto motion = rolled(cylinder, TableLaw({0.1, 0.2, 0.3}, {1e-3, least, 1e-3}), 0.3, 0);
    const double tolerance = 2e-14 + 1e-15 * (1e-3 / least);
    CHECK(std::abs(motion->stop_time() / time - 1) < tolerance);
    motion->seek(motion->stop_time());
    CHECK(std::abs(motion->position() / distance - 1) < tolerance);
  }
}

TEST_CASE("Table: agrees with the solvers on points without a law, in both geometries",
          "[rolling]") {
  for (const bool is_exact : {false, true}) {
    Scene roll{};
    roll.body = cylinder, roll.body.exact = is_exact, roll.v0 = 0.9;
    roll.law = TableLaw(std::vector{0.05, 0.1, 0.3, 0.35, 0.6, 1.0},
                        std::vector{1e-3, 4e-3, 4e-3, 9e-3, 8e-3, 3e-2});
    const auto table = start(roll, best_method(roll), 0),
               solver = start(roll, {Method::solver, gsl_odeiv2_step_rk8pd}, 1e-11);
    CHECK(std::abs(table->stop_time() / solver->stop_time() - 1) < 1e-9);
    for (int i = 0; i <= 110; ++i) {
      const double t = table->stop_time() * i / 100;
      table->seek(t);
      solver->seek(t);
      CHECK(std::abs(table->velocity() - solver->velocity()) < 1e-9);
      CHECK(std::abs(table->position() - solver->position()) < 1e-9);
      CHECK(std::abs(table->shift() - solver->shift()) <
            1e-9 + (table->velocity() < 1e-6 ? 1e-2 : 0));
    }
    CHECK((table->velocity() == 0 && table->shift() == 0 && table->acceleration() == 0));
  }
}

TEST_CASE("Table: rest, and refusals", "[rolling]") {
  const TableLaw law({0.1, 1}, {1e-3, 0.05});
  const auto rest = rolled(cylinder, law, 0, 0.3);
  CHECK(rest->stop_time() == 0);
  rest->seek(1);
  CHECK((rest->velocity() == 0 && rest->position() == 0.3 && rest->shift() == 0));
  CHECK_THROWS_AS(rolled(cylinder, law, 1.1, 0), Error);
  CHECK_THROWS_AS(rolled(cylinder, law, 1, 0), Error);  // D > R
  CHECK_NOTHROW(rolled(exact_body(cylinder), law, 0.5, 0));
  const TableLaw high({0.1, 0.5, 1}, {1e-3, 0.05, 1e-3});
  CHECK_THROWS_AS(rolled(cylinder, high, 1, 0), Error);  // D > R on the way
  CHECK_NOTHROW(rolled(cylinder, high, 0.2, 0));
}
