// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/windows.h"

#include <algorithm>
#include <cmath>

#include "base/median.h"
#include "unit/catch.h"
#include "unit/signal/through.h"

using namespace rolling;

TEST_CASE("sorted_window: as sorting has it, with ties too", "[signal]") {
  for (const double unit : {0.0, 0.25}) {
    SortedWindow window;
    Series all = noise(8000, 6);
    if (unit > 0)
      for (double& y : all) y = std::round(y / unit) * unit;
    const auto check = [&](std::size_t from, std::size_t to) {
      Series sorted(all.begin() + std::ptrdiff_t(from), all.begin() + std::ptrdiff_t(to));
      std::sort(sorted.begin(), sorted.end());
      REQUIRE(window.size() == sorted.size());
      for (std::size_t i = 0; i < sorted.size(); i += 1 + sorted.size() / 50)
        REQUIRE(window[i] == sorted[i]);
      if (sorted.empty()) return;
      CHECK(window.median() == median(sorted));
    };
    std::size_t from = 0, to = 0;
    for (const std::size_t size : {0u, 1u, 2u, 7u, 600u, 5000u, 5001u, 300u, 3u, 0u}) {
      while (to - from < size) window.add(all[to++]);
      while (to - from > size) window.subtract(all[from++]);
      check(from, to);
    }
    while (to < 7000) {  // it slides
      window.add(all[to++]);
      if (to - from > 100) window.subtract(all[from++]);
    }
    check(from, to);
  }
}
