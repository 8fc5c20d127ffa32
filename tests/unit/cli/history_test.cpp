// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/history.h"

#include "base/error.h"
#include "unit/catch.h"
#include "unit/many.h"
#include "unit/fit/simulated.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

using namespace rolling;

namespace {

using Lines = std::vector<std::string>;
using Series = std::vector<double>;

const Series times = {0, 1, 2, 3, 4, 5};

FilterChain filters_in(const Lines& lines, const Series& t) { return history_of(lines, t).filters; }

}  // namespace

TEST_CASE("history: a smooth line is the moving mean that it names", "[cli]") {
  const FilterChain chain = filters_in({"smooth v mean width 3"}, times);
  REQUIRE(chain.size() == 1);
  CHECK(chain[0].from == Quantity::v);
  CHECK(chain[0].to == Quantity::v);
  CHECK(chain[0].reach == 1);
  CHECK(chain[0].apply(times, Series{0, 3, 0, 0, 6, 1}) == Series{0, 1, 1, 2, 7. / 3, 1});
}

TEST_CASE("history: a window of seconds reaches as far as it has samples", "[cli]") {
  const FilterChain chain = filters_in({"smooth v mean seconds 2"}, times);
  REQUIRE(chain.size() == 1);
  CHECK(chain[0].reach >= 1);
  CHECK(chain[0].apply(times, Series{0, 3, 0, 0, 6, 1}) == Series{0, 1, 1, 2, 7. / 3, 1});
}

TEST_CASE("history: a differentiate line is the central derivative, from column to column",
          "[cli]") {
  const Series squares = {0, 1, 4, 9, 16, 25};
  for (const auto& [from, to] : {std::pair{Quantity::x, Quantity::v}, {Quantity::v, Quantity::a}}) {
    const FilterChain chain =
        filters_in({fmt::format("differentiate {} central", name_of(from))}, times);
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
    CHECK(history.filters[0].from == Quantity::a);
    CHECK(history.filters[0].to == Quantity::D);
    CHECK(history.filters[0].reach == 0);
    CHECK(history.filters[0].apply(times, Series{-1}) == Series{-1});
    REQUIRE(history.shift_of);
    CHECK(history.shift_of->K == 0.5);
    CHECK(history.shift_of->R == 0.04);
    CHECK(history.shift_of->g == 6);
    CHECK(history.shift_of->exact == exact);
  }
}

TEST_CASE("history: the filters of a chain stand in its order, lines of others say nothing",
          "[cli]") {
  const FilterChain chain = filters_in(
      {"simulate a 1 b 0", "smooth v mean width 11", "by hand", "", "differentiate v central",
       "shift-from-accel K 0.5 R 0.04 g 9.81", "energy-ledger D"},
      times);
  REQUIRE(chain.size() == 3);
  CHECK(chain[0].to == Quantity::v);
  CHECK(chain[1].to == Quantity::a);
  CHECK(chain[2].to == Quantity::D);
  CHECK(filters_in({}, times).empty());
}

TEST_CASE("history: a second column v hides the first, and what was made of that", "[cli]") {
  const FilterChain chain = filters_in(
      {"smooth v mean width 5", "differentiate v central", "shift-from-accel K 0.5 R 0.04 g 9.81",
       "smooth x mean width 3", "differentiate x central", "smooth v mean width 3"},
      times);
  REQUIRE(chain.size() == 3);
  CHECK(chain[0].to == Quantity::x);
  CHECK(chain[1].to == Quantity::v);
  CHECK(chain[2].from == Quantity::v);
  CHECK(chain[2].reach == 1);
}

TEST_CASE("history: a line that cuts rows away is a cut if a filter stands above it", "[cli]") {
  const auto cuts = [](const std::vector<std::string>& lines) {
    const History history = history_of(lines, times);
    return std::pair(history.cut_begin, history.cut_end);
  };
  const std::string derivative = "differentiate x central", mean = "smooth v mean width 3";
  CHECK(cuts({"smooth x coast", "smooth t from 1", derivative, mean}) == std::pair(false, false));
  CHECK(cuts({"smooth t to 5", derivative, "smooth t from 1", mean}) == std::pair(true, false));
  CHECK(cuts({derivative, mean, "smooth t to 5"}) == std::pair(false, true));
  CHECK(cuts({derivative, "smooth v coast", mean}) == std::pair(true, true));
}

TEST_CASE(
    "history: what sensors may have done to speeds: differences of x, exact on a line, and means "
    "of v",
    "[cli]") {
  std::size_t differences = 0;
  for (const LinearFilter& filter : filters_of_sensors()) {
    CHECK(filter.to == Quantity::v);
    const Series line = {0, 2, 4, 6, 8, 10}, out = filter.apply(times, line);
    if (filter.from == Quantity::x) CHECK((++differences && std::abs(out[3] - 2) < 1e-12));
    else  // at most half a row late
      for (std::size_t i = filter.reach; i + filter.reach < line.size(); ++i)
        CHECK(std::abs(out[i] - line[i]) <= 1);
  }
  CHECK(differences == 5);
}

TEST_CASE("history: of a filter that is not linear nothing can be said", "[cli]") {
  for (const Lines& lines : {Lines{"smooth v median width 11", "differentiate v central"},
                             Lines{"differentiate v spline"}, Lines{"smooth v outliers 3"}}) {
    const History history = history_of(lines, times);
    CHECK(history.filters.empty());
    CHECK(history.doubt.empty());
  }
  CHECK(history_of({"smooth v mean width 3"}, {}).filters.empty());  // filters act on times
}

TEST_CASE("history: of lines that were sorted none is believed, wherever this is said", "[cli]") {
  Lines lines = {"differentiate v central", "lines sorted", "smooth v mean width 3"};
  std::ranges::sort(lines);
  do {
    const History history = history_of(lines, times);
    CHECK(history.filters.empty());
    CHECK(history.doubt == "its `##` lines were sorted, so that their order says nothing");
  } while (std::ranges::next_permutation(lines).found);
}

TEST_CASE("history: a line that is not what its tool writes is not believed", "[cli]") {
  for (const char* line : {"smooth v mean width x",
                           "smooth v mean width -3",
                           "smooth v mean width 0",
                           "smooth v mean width 4",
                           "smooth v mean width 3.9",
                           "smooth v mean width 1e30",
                           "smooth v mean seconds -1",
                           "smooth v mean width 11 outliers 3",
                           "smooth v mean",
                           "smooth v",
                           "smooth",
                           "smooth t from x",
                           "smooth t from",
                           "smooth v coast 1",
                           "smooth v outliers",
                           "differentiate v",
                           "differentiate v savgol",
                           "differentiate v nothing",
                           "shift-from-accel K 0.5 R 0.04",
                           "shift-from-accel K x R 0.04 g 9.81",
                           "shift-from-accel K 0.5 R 0 g 9.81",
                           "shift-from-accel R 0.04 K 0.5 g 9.81",
                           "shift-from-accel K -1 R 0.04 g 9.81",
                           "shift-from-accel K 0.5 R 0.04 g 9.81 tilt 1",
                           "shift-from-accel K 0.5 R 0.04 g 9.81 slope",
                           "shift-from-accel exact",
                           "shift-from-accel K"}) {
    INFO(line);
    const History history = history_of({"smooth v mean width 3", line}, times);
    if (std::string(line) == "smooth") continue;  // one word: no line of the tool's
    CHECK(history.filters.empty());
    CHECK(!history.shift_of);
    CHECK(history.doubt.find("not what its tool writes") != std::string::npos);
  }
}

TEST_CASE("history: uncertainties and the slope of shift-from-accel are read back", "[cli]") {
  const History history =
      history_of({"shift-from-accel K 0.5+-0.005 R 0.04+-1e-05 g 9.81 slope -0.001+-2e-4"}, times);
  REQUIRE(history.shift_of);
  CHECK(history.shift_of->sigma_K == 0.005);
  CHECK(history.shift_of->sigma_R == 1e-5);
  CHECK(history.shift_of->sigma_g == 0);
  CHECK(history.shift_of->sigma_slope == 2e-4);
  CHECK(history.shift_of->slope == -0.001);
  // A body whose mass is all in its axis.
  const auto point = history_of({"shift-from-accel K 0 R 0.04 g 9.81"}, times);
  REQUIRE(point.shift_of);
  CHECK(point.shift_of->K == 0);
}

TEST_CASE(
    "history: filters whose matrices would not fit into memory are not known, and that is told",
    "[cli]") {
  Series many(100'000);
  std::iota(many.begin(), many.end(), 0);
  // 499 rows on either side of each of 100,000, and a hundred filters, do.
  for (const History& h : {history_of({"smooth v mean width 999"}, many),
                           history_of(Lines(100, "smooth v mean width 1"), times)}) {
    CHECK(!h.filters.empty());
    CHECK(h.doubt.empty());
  }
  for (const History& h : {history_of({"smooth v mean width 1003"}, many),
                           history_of(Lines(101, "smooth v mean width 1"), times)}) {
    CHECK(h.filters.empty());
    CHECK(h.doubt.find("too wide or too many") != std::string::npos);
  }
}

namespace {

/// A run of noisy speeds that was smoothed, differentiated and turned into shifts.
Run shifts(std::size_t n, double size = 0.005) {
  Run run{};
  simulated::Noise noise(3);
  for (std::size_t i = 0; i < n; ++i) {
    run.t.push_back(0.04 * static_cast<double>(i));
    run.v.push_back(0.5 - 0.2 * run.t.back() + noise(size));
  }
  const Lines lines{"smooth v mean width 5", "differentiate v central",
                    "shift-from-accel K 0.5 R 0.04 g 9.81"};
  const History history = history_of(lines, run.t);
  run.v = history.filters[0].apply(run.t, run.v);
  run.D = history.filters[1].apply(run.t, run.v);
  for (double& D : run.D) D *= -(1 + 0.5) * 0.04 / 9.81;
  run.filters = history.filters;
  run.shift_of = history.shift_of;
  return run;
}

History claimed(const Run& run) { return {run.filters, run.shift_of, {}}; }

Run cut(const Run& run, std::size_t first, std::size_t last) {
  Run rest = run;
  for (auto column : {&Run::t, &Run::v, &Run::D})
    (rest.*column)
        .assign((run.*column).begin() + static_cast<std::ptrdiff_t>(first),
                (run.*column).begin() + static_cast<std::ptrdiff_t>(last));
  return rest;
}

}  // namespace

TEST_CASE("history: rows cut off the ends after the filters are noticed by the columns", "[cli]") {
  const Run whole = shifts(40);
  const auto cuts = [&](std::size_t first, std::size_t last) {
    Run run = cut(whole, first, last);
    const History history = give_filters(claimed(run), run, {Quantity::v, Quantity::D});
    CHECK(history.filters.size() == 3);
    return std::pair(history.cut_begin, history.cut_end);
  };
  CHECK(cuts(0, 40) == std::pair(false, false));
  CHECK(cuts(5, 40) == std::pair(true, false));
  CHECK(cuts(0, 35) == std::pair(false, true));
  CHECK(cuts(5, 35) == std::pair(true, true));
  Run hole = whole, other = whole, scaled = whole;
  for (auto column : {&Run::t, &Run::v, &Run::D})
    (hole.*column).erase((hole.*column).begin() + 20, (hole.*column).begin() + 25);
  for (double& D : other.D) D *= 1.2;
  for (double& D : scaled.D) D *= 1.0001;
  for (Run run : {hole, other, scaled}) {
    const History history = give_filters(claimed(run), run, {Quantity::v, Quantity::D});
    CHECK(history.filters.empty());
    CHECK(history.doubt == "the columns are not what the `##` lines say");
  }
  // Of many numbers the largest are rounded by far more than the median one: here |D| is 2.6e-3 on
  // average, and a few are above 1e-2.
  for (const int digits : {3, 4, 6}) {
    Run rounded = shifts(50000, 0.085);
    for (double& D : rounded.D) D = std::stod(fmt::format("{:.{}g}", D, digits));
    CHECK(give_filters(claimed(rounded), rounded, {Quantity::v, Quantity::D}).filters.size() == 3);
  }
  for (const double unit : {1e-7, 1e-6, 1e-5}) {
    Run rounded = whole;
    for (double& D : rounded.D) D = unit * std::round(D / unit);
    CHECK(give_filters(claimed(rounded), rounded, {Quantity::v, Quantity::D}).filters.size() == 3);
  }
}

TEST_CASE("history: the readings beside a cut are left out, their times are not", "[cli]") {
  for (const auto& [begin, end] : {std::pair(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
    Run run = shifts(40);
    const Run whole = run;
    History history = claimed(run);
    history.cut_begin = begin == 1, history.cut_end = end == 1;
    history = give_filters(std::move(history), run, {Quantity::v, Quantity::D});
    CHECK(history.filters.size() == 3);
    CHECK(run.t == whole.t);
    // A mean of 5 and a central difference reach 3 rows to either side.
    CHECK(history.left_out == 3U * static_cast<std::size_t>(begin + end));
    for (std::size_t i = 0; i < 40; ++i) {
      const bool left_out = (begin == 1 && i < 3) || (end == 1 && i >= 37);
      CHECK((left_out ? std::isnan(run.D[i]) : run.D[i] == whole.D[i]));
      // A speed has read 2.
      const bool no_v = (begin == 1 && i < 2) || (end == 1 && i >= 38);
      CHECK((no_v ? std::isnan(run.v[i]) : run.v[i] == whole.v[i]));
    }
  }
  Run few = shifts(15);
  History history = claimed(few);
  history.cut_begin = history.cut_end = true;
  history = give_filters(std::move(history), few, {Quantity::v, Quantity::D});
  CHECK(history.filters.empty());
  CHECK(history.doubt.ends_with("fewer than 10 rows are far enough from the cut"));
  CHECK(std::isfinite(few.D.front()));
}

// What must never happen is a crash or a run without end: whatever the lines say, a fit answers or
// refuses.
TEST_CASE("history: damaged at random, it gives a fit or a refusal", "[cli][fit][many]") {
  std::mt19937 random(20);
  const auto any = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const Lines good{"smooth v coast",
                   "smooth t from 0.1",
                   "differentiate x central",
                   "smooth v mean width 5",
                   "smooth x mean seconds 0.3",
                   "differentiate v central",
                   "differentiate v savgol width 7 order 2",
                   "smooth v savgol width 5 order 2",
                   "shift-from-accel K 0.5 R 0.04 g 9.81",
                   "smooth D mean width 3",
                   "shift-from-accel exact K 0.5 R 0.04 g 9.81 slope 0.001",
                   "smooth a mean width 3",
                   "differentiate D vernier",
                   "energy-ledger m 1"};
  const char* const words[] = {"1e308",  "-1", "nan",   "999999999", "0",    "x",
                               "v",      "a",  "D",     "width",     "3",    "seconds",
                               "1e-300", "K",  "exact", "",          "\x80", "coast"};
  const unsigned runs = of_many(2000);
  std::size_t fitted = 0, refused = 0;
  for (unsigned k = 0; k < runs; ++k) {
    Run run = shifts(k % 3 ? 5 + any(30) : 2 + any(5));
    if (k % 7 == 0) run.t.clear();
    Lines lines;
    for (std::size_t i = any(6); i > 0; --i) {
      std::string line = good[any(good.size())];
      for (std::size_t damage = any(3); damage > 0 && !line.empty(); --damage) {
        const std::size_t at = any(line.size());
        if (any(2)) line[at] = static_cast<char>('!' + any(90));
        else line.replace(at, any(8), words[any(std::size(words))]);
      }
      lines.push_back(std::move(line));
    }
    run.x = run.v;
    run.body = {1, 0.04, 0.5};
    for (const Route route : {Route::loglog, Route::shift, Route::velocity, Route::position}) try {
        if (run.t.empty() && is_trajectory(route)) continue;
        std::vector<Quantity> columns{fitted_column(route)};
        if (!is_trajectory(route)) columns.push_back(Quantity::D);
        give_filters(history_of(lines, run.t), run, columns);
        const FitResult r = fit(route, {run}, {});
        CHECK(std::isfinite(r.a));
        ++fitted;
      } catch (const Error&) {
        ++refused;
      }
  }
  CHECK(fitted > runs / 4);
  CHECK(refused > runs / 4);
}
