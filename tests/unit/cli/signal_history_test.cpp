// SPDX-License-Identifier: GPL-3.0-or-later
// What smooth and differentiate say in their `##` lines, read back.
#include "cli/history.h"

#include "signal/method.h"
#include "unit/catch.h"
#include "unit/signal/through.h"

using namespace rolling;

TEST_CASE("history: each linear method comes back as the same filter", "[cli]") {
  const Series t = uneven_times(60), y = noise(60, 1);
  for (const SignalMethod& method : derivative_methods) {
    INFO(method.name);
    const SignalOptions options{&method, {7, 0}, 3};
    const auto chain = history_of({"differentiate x " + describe(options)}, t).filters;
    if (!method.linear) {  // its parameter depends on the data
      CHECK(chain.empty());
      continue;
    }
    REQUIRE(chain.size() == 1);
    CHECK(chain[0].to == Quantity::v);
    CHECK(chain[0].reach == reach(options, t));
    CHECK(chain[0].apply(t, y) == through(*make_signal(options), t, y));
  }
  for (const SignalMethod& method : smoothing_methods)
    for (const Width width : {Width{7, 0}, Width{0, 0.3}}) {
      INFO(method.name);
      const SignalOptions options{&method, width, 3};
      const auto chain = history_of({"smooth v coast", "smooth t from 1.5", "smooth t to 2",
                                     "smooth v " + describe(options)},
                                    t)
                             .filters;
      if (!method.linear) {  // not linear
        CHECK(chain.empty());
        continue;
      }
      REQUIRE(chain.size() == 1);
      CHECK(chain[0].apply(t, y) == through(*make_signal(options), t, y));
    }
  CHECK(history_of({"smooth v outliers 4", "smooth v mean width 11"}, t).filters.empty());
}
