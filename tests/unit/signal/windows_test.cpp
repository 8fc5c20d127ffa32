#include "signal/windows.h"

#include "base/error.h"
#include "unit/catch.h"
#include "unit/signal/through.h"

using namespace rolling;

namespace {

struct Window {
  std::size_t at, begin, end;
  bool operator==(const Window&) const = default;
};

/// The windows of a run, and with each how many samples had come when it was known.
std::vector<Window> windows(const Series& t, Width width, Windows::Ends ends,
                            std::vector<std::size_t>* known = nullptr) {
  Windows all(width, ends);
  std::vector<Window> out;
  const auto take = [&](std::size_t count) {
    while (all.next()) {
      out.push_back({all.at(), all.begin(), all.end()});
      for (std::size_t i = all.begin(); i < all.end(); ++i) CHECK(all.sample(i).t == t[i]);
      if (known) known->push_back(count);
    }
  };
  for (std::size_t i = 0; i < t.size(); ++i) all.push(t[i], 0), take(i + 1);
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
