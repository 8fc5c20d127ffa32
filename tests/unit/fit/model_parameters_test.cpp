// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/model.h"

#include "unit/catch.h"

using namespace rolling;

TEST_CASE("parameters: a run by itself has the law, v0 and x0 that it has among others", "[fit]") {
  for (bool fit_slope : {false, true})
    for (bool hold_a : {false, true}) {
      Body given{1, 1, 1};
      given.slope = 7;
      FitOptions options;
      options.fit_slope = fit_slope;
      if (hold_a) options.fixed[0] = 2e-3;
      const Parameters all(options, true, 3, 0.25, 2), one = all.of_one_run();
      auto theta = all.theta({2e-3, 0.3}, {0.4, 0.5, 0.6}, {1, 2, 3});
      REQUIRE(theta.size() == all.count());
      if (fit_slope) theta.back() = 1.5;
      CHECK(all.body(theta, given).slope == (fit_slope ? 1.5e-3 : 7));
      for (std::size_t r = 0; r < 3; ++r) {
        auto own = all.theta_of_runs(theta, {r});
        REQUIRE(own.size() == one.count() + fit_slope);
        own.resize(one.count());
        CHECK(one.v0(own, 0) == all.v0(theta, r));
        CHECK(one.x0(own, 0) == all.x0(theta, r));
        CHECK(one.law(own).c(0) == all.law(theta).c(0));
        CHECK(one.law(own).c(1) == all.law(theta).c(1));
        CHECK(one.body(own, given).slope == 7);
      }
    }
}
