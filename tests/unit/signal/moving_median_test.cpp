// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/moving.h"

#include "base/error.h"
#include "unit/catch.h"
#include "unit/signal/through.h"

using namespace rolling;

namespace {

Series medians(const Series& t, const Series& y, Width width) {
  return through(*moving_median(width), t, y);
}
Series medians(const Series& y, std::size_t width) {
  return medians(even_times(y.size()), y, {width, 0});
}

}  // namespace

TEST_CASE("moving_median: by hand", "[signal]") {
  CHECK(medians({1, 5, 3}, 3) == Series{1, 3, 3});
  CHECK(medians({1, 9, 6, 7, 4}, 5) == Series{1, 6, 6, 6, 4});
  CHECK(medians({7}, 11) == Series{7});
  CHECK(medians(Series{}, 11).empty());
  CHECK(medians({2, 2, 2, 5, 2}, 3) == Series{2, 2, 2, 2, 2});
}

TEST_CASE("moving_median: as sorting each window has it", "[signal]") {
  Series y = noise(6000, 2);
  for (std::size_t i = 0; i < y.size(); i += 3) y[i] = 0.25;  // ties
  for (const std::size_t width : {1u, 3u, 11u, 99u, 2001u}) {
    const auto out = medians(y, width);
    REQUIRE(out.size() == y.size());
    for (std::size_t i = 0; i < y.size(); ++i) {
      const auto k = static_cast<std::ptrdiff_t>(std::min({width / 2, i, y.size() - 1 - i})),
                 at = static_cast<std::ptrdiff_t>(i);
      Series window(y.begin() + at - k, y.begin() + at + k + 1);
      std::sort(window.begin(), window.end());
      REQUIRE(out[i] == window[static_cast<std::size_t>(k)]);
    }
  }
}

TEST_CASE("moving_median: what only rises comes out as itself, to its ends, on uneven times too",
          "[signal]") {
  Series t = uneven_times(60), y;
  for (const double time : t) y.push_back(time * time * time);
  CHECK(medians(t, y, {9, 0}) == y);
  CHECK(medians(t, y, {0, 0.7}) == y);
}

TEST_CASE("moving_median: half of a window of outliers changes nothing, and time may run backwards",
          "[signal]") {
  Series y(60, 3);
  for (const std::size_t i : {20u, 21u, 22u, 23u, 24u}) y[i] = 1e300;
  CHECK(medians(y, 11) == Series(60, 3));
  CHECK(medians(y, 9) != Series(60, 3));
  const Series t = uneven_times(80), z = noise(80, 8);
  CHECK(backwards(medians(backwards(t, -1), backwards(z), {0, 0.3})) == medians(t, z, {0, 0.3}));
}

TEST_CASE("moving_median: an even width is refused", "[signal]") {
  CHECK_THROWS_AS(moving_median({10, 0}), Error);
}
