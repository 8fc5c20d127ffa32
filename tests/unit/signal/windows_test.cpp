// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/windows.h"

#include <algorithm>
#include <random>
#include <set>
#include <span>

#include "base/error.h"
#include "unit/catch.h"
#include "unit/signal/through.h"

using namespace rolling;

namespace {

struct Window {
  std::size_t at, begin, end;
  bool operator==(const Window&) const = default;
};

struct Held {
  std::multiset<double> readings;
  void add(double y) { readings.insert(y); }
  void subtract(double y) { CHECK(readings.erase(y) == 1); }
};

/// The windows of a run, and with each how many samples had come when it was known. What Sliding
/// holds at each window are its readings, which are their times.
std::vector<Window> windows(const Series& t, Width width, Windows::Ends ends,
                            std::vector<std::size_t>* known = nullptr) {
  Windows all(width, ends);
  std::vector<Window> out;
  Sliding<Held> held;
  const auto take = [&](std::size_t count) {
    while (all.next()) {
      out.push_back({all.at(), all.begin(), all.end()});
      CHECK(
          std::ranges::equal(held.of(all).readings, std::span(t).subspan(all.begin(), all.size())));
      if (known) known->push_back(count);
    }
  };
  for (std::size_t i = 0; i < t.size(); ++i) all.push(t[i], t[i]), take(i + 1);
  all.finish();
  take(t.size());
  return out;
}

constexpr auto shrink = Windows::Ends::shrink, cut = Windows::Ends::cut, stay = Windows::Ends::stay;

}  // namespace

TEST_CASE("windows: what becomes of them at the ends", "[signal]") {
  const Series t = even_times(6, 1);
  for (const Width width : {Width{5, 0}, Width{0, 4}}) {
    CHECK(windows(t, width, shrink) ==
          std::vector<Window>{{0, 0, 1}, {1, 0, 3}, {2, 0, 5}, {3, 1, 6}, {4, 3, 6}, {5, 5, 6}});
    CHECK(windows(t, width, cut) ==
          std::vector<Window>{{0, 0, 3}, {1, 0, 4}, {2, 0, 5}, {3, 1, 6}, {4, 2, 6}, {5, 3, 6}});
    CHECK(windows(t, width, stay) ==
          std::vector<Window>{{0, 0, 5}, {1, 0, 5}, {2, 0, 5}, {3, 1, 6}, {4, 1, 6}, {5, 1, 6}});
  }
}

TEST_CASE("windows: a run shorter than the window", "[signal]") {
  for (const Width width : {Width{9, 0}, Width{0, 8}}) {
    CHECK(windows({0, 1, 2}, width, stay) == std::vector<Window>{{0, 0, 3}, {1, 0, 3}, {2, 0, 3}});
    CHECK(windows({0, 1, 2}, width, cut) == std::vector<Window>{{0, 0, 3}, {1, 0, 3}, {2, 0, 3}});
    CHECK(windows({0, 1, 2}, width, shrink) ==
          std::vector<Window>{{0, 0, 1}, {1, 0, 3}, {2, 2, 3}});
    for (const auto ends : {shrink, cut, stay}) CHECK(windows({}, width, ends).empty());
  }
}

TEST_CASE("windows: by seconds, on uneven times", "[signal]") {
  const Series t = {0, 1, 1.5, 2, 9};
  CHECK(windows(t, {0, 2}, cut) ==
        std::vector<Window>{{0, 0, 2}, {1, 0, 4}, {2, 1, 4}, {3, 1, 4}, {4, 4, 5}});
  CHECK(windows(t, {0, 2}, stay) ==
        std::vector<Window>{{0, 0, 4}, {1, 0, 4}, {2, 1, 4}, {3, 1, 4}, {4, 4, 5}});
}

TEST_CASE("windows: by seconds, at every offset of the times", "[signal]") {
  // Even times, the edge of the window on a sample: the same windows as by count, although the
  // times are rounded (a double near 1.7e9 to 1.2e-7).
  for (const double rate : {10., 25., 30., 250., 1000., 20000.})
    for (const double offset : {0., -1.5, 1e5, 1e7, 1.7e9, -1.7e9})
      for (const std::size_t k : {1u, 2u, 5u, 13u})
        for (const auto ends : {shrink, cut, stay}) {
          INFO(rate << " Hz from " << offset << " s, " << k << " samples to either side");
          Series t;
          for (int i = 0; i < 60; ++i) t.push_back(offset + i / rate);
          const double seconds = 2 * static_cast<double>(k) / rate;
          CHECK(windows(t, {0, seconds}, ends) == windows(t, {2 * k + 1, 0}, ends));
        }
  // And on uneven times.
  const Series t = uneven_times(300);
  for (const double offset : {-1.5, 1e5, 1e7, 1.7e9})
    for (const auto ends : {shrink, cut, stay}) {
      Series later;
      for (const double time : t) later.push_back(offset + time);
      CHECK(windows(later, {0, 0.37}, ends) == windows(t, {0, 0.37}, ends));
    }
}

TEST_CASE("windows: by seconds, each has all of its samples, whatever is lost", "[signal]") {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int run = 0; run < 300; ++run) {
    const double lost = uniform(random), seconds = 40 * uniform(random) * uniform(random);
    Series t;
    for (int i = 0; i < 150; ++i)
      if (uniform(random) > lost) t.push_back(i + 0.3 * uniform(random));
    for (const std::size_t least : {1u, 11u})
      for (const auto ends : {shrink, cut, stay})
        CHECK(windows(t, {0, seconds, least}, ends).size() == t.size());
  }
}

TEST_CASE("windows: of reversed times they are the reverse", "[signal]") {
  for (const Width width : {Width{7, 0}, Width{0, 0.37}, Width{0, 2}})
    for (const auto ends : {shrink, cut, stay})
      for (std::size_t n = 1; n < 60; ++n) {
        const Series t = uneven_times(n);
        Series back;
        for (std::size_t i = n; i-- > 0;) back.push_back(-t[i]);
        std::vector<Window> all = windows(back, width, ends), forth(all.rbegin(), all.rend());
        for (Window& window : forth) window = {n - 1 - window.at, n - window.end, n - window.begin};
        INFO(n << " rows, width " << width.samples << " or " << width.seconds << " s");
        CHECK(windows(t, width, ends) == forth);
      }
}

TEST_CASE("windows: a sample that is late by a sixteenth of its step is within", "[signal]") {
  const Series t = {0, 1, 2, 3, 4.0625, 5.125, 6.25};
  CHECK(windows(t, {0, 2}, cut) ==
        std::vector<Window>{
            {0, 0, 2}, {1, 0, 3}, {2, 1, 4}, {3, 2, 5}, {4, 3, 6}, {5, 4, 6}, {6, 6, 7}});
}

TEST_CASE("windows: known as soon as they are complete", "[signal]") {
  const auto known = [](Width width, Windows::Ends ends) {
    std::vector<std::size_t> counts;
    windows(even_times(7, 1), width, ends, &counts);
    return counts;
  };
  CHECK(known({5, 0}, shrink) == std::vector<std::size_t>{1, 3, 5, 6, 7, 7, 7});
  CHECK(known({5, 0}, cut) == std::vector<std::size_t>{3, 4, 5, 6, 7, 7, 7});
  CHECK(known({5, 0}, stay) == std::vector<std::size_t>{5, 5, 5, 6, 7, 7, 7});
}

TEST_CASE("windows: an even width is refused", "[signal]") {
  CHECK_THROWS_AS(Windows({4, 0}, cut), Error);
  CHECK_THROWS_AS(Windows({0, 0}, cut), Error);
}
