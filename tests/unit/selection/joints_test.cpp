// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/joints.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "unit/catch.h"
#include "unit/normal.h"
#include "unit/signal/through.h"

using namespace rolling;

// Speeds of 0.5 m/s that fall by 0.2 m/s^2: to rest at 2.5 s, or to a hand that takes 0.3 m/s to 0
// from 1 s on within 0.2 s.
TEST_CASE("joints: a stop and a hand are told apart by their RSS", "[signal]") {
  constexpr double size = 0.002;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Series e = noise(100, seed);
    std::vector<Sample> rest;
    std::vector<Sample> hand;
    for (const double of_noise : e) {
      const double t = 0.04 * static_cast<double>(rest.size());
      const double held =
          0.15 * (1 + std::cos(3.14159265358979 * std::clamp(t - 1, 0.0, 0.2) / 0.2));
      rest.push_back({t, std::max(0.0, 0.5 - 0.2 * t) + size * of_noise});
      hand.push_back({t, (t < 1 ? 0.5 - 0.2 * t : held) + size * of_noise});
    }
    const Joints at_rest(rest, false, size);
    const Joints by_hand(hand, false, size);
    const Ending stop = at_rest.before_stop(0, 62, rest.size());
    const Ending caught = by_hand.before_hand(0, 30, hand.size());
    CHECK(rest[stop.end - 1].t <= 2.5);
    CHECK(rest[stop.end - 1].t > 2);
    CHECK(hand[caught.end].t == Approx(1).margin(0.08));
    CHECK(caught.rss + 25 < by_hand.before_stop(0, 30, hand.size()).rss);
    CHECK(at_rest.before_hand(0, 62, rest.size()).rss > stop.rss - 9);
  }
}
