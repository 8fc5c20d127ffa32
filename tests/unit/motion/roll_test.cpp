#include "motion/roll.h"

#include <vector>

#include "base/error.h"
#include "unit/catch.h"

using namespace rolling;

TEST_CASE("Roll: the best method, and methods that do not fit the scene", "[rolling]") {
  Roll roll{};
  roll.body = {1.375, 0.04, 0.5}, roll.law = {1e-3, 0.2}, roll.v0 = 0.5;
  CHECK(best_method(roll).kind == Method::closed);
  CHECK_THROWS_AS(start(roll, {Method::exact}, 1e-8), Error);
  roll.geometry = Geometry::exact;
  CHECK(best_method(roll).kind == Method::exact);
  CHECK_THROWS_AS(start(roll, {Method::closed}, 1e-8), Error);
  roll.bulge.length = 1e-3;
  CHECK(best_method(roll).kind == Method::solver);
  CHECK_THROWS_AS(start(roll, {Method::exact}, 1e-8), Error);
  roll.table.emplace(std::vector{0.1, 1.0}, std::vector{1e-3, 2e-3});
  CHECK_THROWS_AS(start(roll, {Method::solver}, 1e-8), Error);
  roll.bulge.length = 0;
  CHECK(best_method(roll).kind == Method::exact);
  CHECK_THROWS_AS(start(roll, {Method::closed}, 1e-8), Error);
  roll.v0 = 1.5;
  CHECK_THROWS_AS(start(roll, {Method::exact}, 1e-8), Error);
  CHECK_THROWS_AS(start(roll, {Method::solver}, 1e-8), Error);
}
