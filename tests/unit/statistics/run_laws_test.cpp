// SPDX-License-Identifier: GPL-3.0-or-later
#include "statistics/run_laws.h"

#include "unit/catch.h"

using namespace rolling;

TEST_CASE("run laws: two laws whose errors are known, by hand", "[statistics]") {
  const std::vector<OwnLaw> laws{{4, {0, 0.2}, {1e-4, 0, 4e-4}, 1e6},
                                 {7, {0.03, 0.2}, {1e-4, 0, 4e-4}, 1e6}};
  const Agreement found = compare(laws, 2, 0);
  CHECK(found.chi2 == Approx(0.03 * 0.03 / 2e-4));
  CHECK(found.ratio == Approx(found.chi2).epsilon(1e-4));
  CHECK(found.p == Approx(std::exp(-4.5 / 2)).epsilon(1e-4));
  CHECK(found.run == 4);
  CHECK(found.log_D.value == Approx(-0.03));
}

TEST_CASE("run laws: how far a run is off is told at a speed that the runs had", "[statistics]") {
  const Symmetric C{1e-4, -1.5e-4, 4e-4};
  const std::vector<OwnLaw> laws{{0, {0, 0.2}, C, 1e6}, {1, {0.03, 0.1}, C, 1e6}};
  const Agreement anywhere = compare(laws, 2, 0);
  CHECK(anywhere.speed == Approx(std::exp(0.375)));
  const Agreement found = compare(laws, 2, 0, 1.2);
  CHECK(found.speed == Approx(1.2));
  CHECK(found.log_D.value == Approx(-0.03 + 0.1 * std::log(1.2)));
  CHECK(found.chi2 == anywhere.chi2);
}

TEST_CASE("run laws: in another unit of speed ln D takes the place of ln a", "[statistics]") {
  const OwnLaw one{0, {-6, 0.2}, {1e-4, 1.5e-4, 4e-4}, 10};
  CHECK(one.best_log_v() == Approx(-0.375));
  const Pair there = in_unit(one.law, one.best_log_v());
  CHECK(there.a == Approx(-6 - 0.375 * 0.2));
  CHECK(one.log_D(-0.375).value == there.a);
  CHECK(in_unit(there, 0.375).a == Approx(-6));
  CHECK(one.log_D(0).sigma == Approx(0.01));
}
