// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/selection.h"

#include "unit/catch.h"
#include "unit/signal/through.h"

using namespace rolling;

TEST_CASE("selection: times, then outliers, then the roll; nothing reaches into what is left out",
          "[signal]") {
  std::vector<Sample> run;  // rest, a push to 0.5 m/s at 1.5 s, a roll that stops at 6.5 s, rest
  const Series e = noise(200, 3);
  for (std::size_t i = 0; i < 200; ++i) {
    const double t = 0.04 * static_cast<double>(i);
    run.push_back({t, (t < 1 || t > 6.5 ? 0 : t < 1.5 ? t - 1 : 0.1 * (6.5 - t)) + 0.008 * e[i]});
  }
  run[20].y = 9, run[100].y = 9;  // the greatest speeds by far
  SelectionOptions options;
  options.outliers = 5, options.coast = true, options.from = 0.5, options.to = 4.3;
  Selection selection(options);
  for (const Sample& s : run)
    CHECK(selection.push(s.t, s.y).empty());  // it waits for the whole run
  selection.finish();
  std::vector<Judged> all;
  for (auto more = selection.rest(); !more.empty(); more = selection.rest())
    all.insert(all.end(), more.begin(), more.end());
  REQUIRE(all.size() == run.size());
  CHECK(selection.outliers() == std::vector<double>{run[20].t, run[100].t});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double t = run[i].t;
    INFO(t);
    if (t < 1.55 || t > 4.3 || i == 100) CHECK(!all[i].kept);
    else if (t > 2) CHECK((all[i].kept && all[i].t == t && all[i].y == run[i].y));
  }
}

TEST_CASE("selection: without the roll it waits for no more than a window", "[signal]") {
  SelectionOptions options;
  options.from = 2, options.to = 7;
  Selection times(options);
  for (int i = 0; i < 10; ++i) {
    const auto now = times.push(i, 0);
    REQUIRE(now.size() == 1);
    CHECK(now[0].kept == (i >= 2 && i <= 7));
  }
  times.finish();
  CHECK(times.rest().empty());
  options.outliers = 3, options.width = {5, 0};
  Selection both(options);
  std::vector<std::size_t> counts;
  for (int i = 0; i < 10; ++i) counts.push_back(both.push(i, 0).size());
  CHECK(counts == std::vector<std::size_t>{1, 1, 0, 0, 0, 0, 0, 0, 7,
                                           1});  // the window ends with the selection
  both.finish();
  CHECK(both.rest().empty());
}
