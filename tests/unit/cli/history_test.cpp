#include "cli/history.h"

#include "base/error.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

using Lines = std::vector<std::string>;
using Series = std::vector<double>;

const Series times = {0, 1, 2, 3, 4, 5};

}  // namespace

TEST_CASE("history: a smooth line is the moving mean that it names", "[cli]") {
  const FilterChain chain = filters_of({"smooth v mean width 3"}, times);
  REQUIRE(chain.size() == 1);
  CHECK(chain[0].from == "v");
  CHECK(chain[0].to == "v");
  CHECK(chain[0].reach == 1);
  CHECK(chain[0].apply(times, Series{0, 3, 0, 0, 6, 1}) == Series{0, 1, 1, 2, 7. / 3, 1});
}

TEST_CASE("history: a window of seconds reaches as far as it has samples", "[cli]") {
  const FilterChain chain = filters_of({"smooth v mean seconds 2"}, times);
  REQUIRE(chain.size() == 1);
  CHECK(chain[0].reach >= 1);
  CHECK(chain[0].apply(times, Series{0, 3, 0, 0, 6, 1}) == Series{0, 1, 1, 2, 7. / 3, 1});
}

TEST_CASE("history: a differentiate line is the central derivative, from column to column",
          "[cli]") {
  const Series squares = {0, 1, 4, 9, 16, 25};
  for (const auto& [from, to] : {std::pair{"x", "v"}, {"v", "a"}, {"w", "dw"}}) {
    const FilterChain chain =
        filters_of({std::string("differentiate ") + from + " central"}, times);
    REQUIRE(chain.size() == 1);
    CHECK(chain[0].from == from);
    CHECK(chain[0].to == to);
    CHECK(chain[0].reach == 1);
    CHECK(chain[0].apply(times, squares) == Series{0, 2, 4, 6, 8, 10});
  }
}

TEST_CASE("history: a shift-from-accel line tells the body and the geometry; D stands for a",
          "[cli]") {
  for (const bool exact : {false, true}) {
    const History history = history_of(
        {std::string("shift-from-accel ") + (exact ? "exact " : "") + "K 0.5 R 0.04 g 6"}, times);
    REQUIRE(history.filters.size() == 1);
    CHECK(history.filters[0].from == "a");
    CHECK(history.filters[0].to == "D");
    CHECK(history.filters[0].reach == 0);
    CHECK(history.filters[0].apply(times, Series{-1}) == Series{-1});
    REQUIRE(history.shift_of);
    CHECK(history.shift_of->body.K == 0.5);
    CHECK(history.shift_of->body.R == 0.04);
    CHECK(history.shift_of->body.g == 6);
    CHECK((history.shift_of->geometry == Geometry::exact) == exact);
  }
}

TEST_CASE("history: the filters of a chain stand in its order, lines of others say nothing",
          "[cli]") {
  const FilterChain chain = filters_of(
      {"simulate a 1 b 0", "smooth v mean width 11", "by hand", "", "differentiate v central",
       "shift-from-accel K 0.5 R 0.04 g 9.81", "energy-ledger D"},
      times);
  REQUIRE(chain.size() == 3);
  CHECK(chain[0].to == "v");
  CHECK(chain[1].to == "a");
  CHECK(chain[2].to == "D");
  CHECK(filters_of({}, times).empty());
}

TEST_CASE("history: records that a line cuts away are missing to the next filter", "[cli]") {
  const FilterChain chain =
      filters_of({"smooth t from 1", "differentiate x central", "smooth t to 5",
                  "smooth v mean width 3", "smooth v coast", "smooth v mean width 1"},
                 times);
  REQUIRE(chain.size() == 3);
  CHECK((chain[0].cut_begin && !chain[0].cut_end));
  CHECK((!chain[1].cut_begin && chain[1].cut_end));
  CHECK((chain[2].cut_begin && chain[2].cut_end));
}

TEST_CASE(
    "history: what sensors may have done to speeds: differences of x, exact on a line, and means "
    "of v",
    "[cli]") {
  std::size_t differences = 0;
  for (const LinearFilter& filter : filters_of_sensors()) {
    CHECK(filter.to == "v");
    const Series line = {0, 2, 4, 6, 8, 10}, out = filter.apply(times, line);
    if (filter.from == "x") CHECK((++differences && std::abs(out[3] - 2) < 1e-12));
    else CHECK(std::abs(out[2] - line[2]) <= 1);  // at most half a record late
  }
  CHECK(differences == 3);
}

TEST_CASE("history: of a filter that is not linear, or not known, nothing can be said", "[cli]") {
  CHECK(filters_of({"smooth v median width 11", "differentiate v central"}, times).empty());
  CHECK(filters_of({"smooth v mean width 11", "differentiate v savgol"}, times).empty());
  CHECK(filters_of({"smooth v mean width 11 outliers 3"}, times).empty());
}

TEST_CASE("history: a line that was tampered with is refused", "[cli]") {
  for (const char* line :
       {"smooth v mean width x", "smooth v mean width -3", "smooth v mean width 0",
        "smooth v mean width 4", "smooth v mean width 1e30", "smooth v mean seconds -1",
        "shift-from-accel K 0.5 R 0.04", "shift-from-accel K x R 0.04 g 9.81"}) {
    INFO(line);
    CHECK_THROWS_AS(
        [&] {
      for (const LinearFilter& filter : filters_of({line}, times)) filter.apply(times, times);
        }(),
        Error);
  }
}
