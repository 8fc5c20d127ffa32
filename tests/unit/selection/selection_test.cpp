// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/selection.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "unit/catch.h"
#include "unit/many.h"
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
  const auto all = selection.finish();
  REQUIRE(all.size() == run.size());
  CHECK(selection.outliers() == std::vector<double>{run[20].t, run[100].t});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double t = run[i].t;
    INFO(t);
    if (t < 1.55 || t > 4.3 || i == 100) CHECK(std::isnan(all[i].y));
    else if (t > 2) CHECK((all[i].t == t && all[i].y == run[i].y));
  }
}

TEST_CASE("selection: of a long run that begins later, each sample once and the same roll",
          "[signal]") {
  std::vector<Sample> run;
  const Series e = noise(3500, 5);
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double t = 0.004 * static_cast<double>(i);
    run.push_back({t, (t < 3 || t > 12 ? 0 : 0.05 * (12 - t)) + 0.004 * e[i]});
  }
  constexpr std::size_t late = 250;
  SelectionOptions options;
  options.coast = true, options.from = run[late].t;
  Selection selection(options);
  for (const Sample& s : run) CHECK(selection.push(s.t, s.y).empty());
  const auto all = selection.finish();
  const Stretch roll = free_roll(std::span(run).subspan(late), false).kept;
  REQUIRE(all.size() == run.size());
  for (std::size_t i = 0; i < run.size(); ++i) {
    CHECK(all[i].t == run[i].t);
    if (i >= late + roll.begin && i < late + roll.end) CHECK(all[i].y == run[i].y);
    else CHECK(std::isnan(all[i].y));
  }
}

TEST_CASE("selection: without the roll it waits for no more than a window", "[signal]") {
  SelectionOptions options;
  options.from = 2, options.to = 7;
  Selection times(options);
  for (int i = 0; i < 10; ++i) {
    const auto now = times.push(i, 0);
    REQUIRE(now.size() == 1);
    CHECK(std::isnan(now[0].y) == (i < 2 || i > 7));
  }
  CHECK(times.finish().empty());
  options.outliers = 3, options.width = {5, 0};
  Selection both(options);
  std::vector<std::size_t> counts;
  for (int i = 0; i < 10; ++i) counts.push_back(both.push(i, 0).size());
  CHECK(counts == std::vector<std::size_t>{1, 1, 0, 0, 0, 0, 0, 0, 7,
                                           1});  // the window ends with the selection
  CHECK(both.finish().empty());
}

namespace {

/// At 25 Hz, with one reading that is off: 1 s of rest, a push of 0.5 s to 0.5 m/s, perhaps a hold,
/// a roll that slows evenly down to its stop, rest. Speeds have ten times the noise of positions.
std::vector<Sample> made_run(unsigned seed, bool positions, double size) {
  const Series e = noise(220, seed);
  const double hold = 0.4 * (seed % 3), a = 0.08 + 0.02 * (seed % 4);
  const auto speed = [&](double t) {
    if (t < 1.5) return t < 1 ? 0 : 0.5 * std::pow(std::sin(3.14159265358979 * (t - 1)), 2);
    return std::clamp(0.5 - a * (t - 1.5 - hold), 0.0, 0.5);
  };
  std::vector<Sample> run;
  double x = 0.3;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double t = 0.04 * static_cast<double>(i);
    for (int k = 0; i > 0 && k < 20; ++k) x += speed(t - (k + 0.5) / 500) / 500;
    run.push_back({t, positions ? x + size * e[i] : speed(t) + 10 * size * e[i]});
  }
  run[60 + seed % 100].y += positions ? 0.05 : 0.3;
  return run;
}

/// Which samples are kept, and what is told of the roll.
std::pair<std::vector<bool>, std::string> selected(const std::vector<Sample>& run,
                                                   const SelectionOptions& options) {
  Selection selection(options);
  std::vector<bool> kept;
  const auto take = [&](std::span<const Sample> samples) {
    for (const Sample& s : samples) kept.push_back(!std::isnan(s.y));
  };
  for (const Sample& s : run) take(selection.push(s.t, s.y));
  take(selection.finish());
  std::string told;
  for (const FreeRoll& roll : selection.rolls())
    told = std::to_string(static_cast<int>(roll.how)) + (roll.other ? ", or another" : "");
  return {kept, told};
}

}  // namespace

TEST_CASE("selection: units, origins and the direction of x do not matter", "[signal]") {
  constexpr double ms = 1000, minutes = 1 / 60.0, cm = 100, feet = 1 / 0.3048;
  const auto check = [](const auto& run, SelectionOptions options, auto change) {
    std::vector<Sample> other = run;
    for (Sample& s : other) s = change(s);
    CHECK(selected(other, options) == selected(run, options));
  };
  for (const bool coast : {false, true})
    for (const bool positions : {false, true})
      for (const double size : {1e-4, 3e-4, 1e-3, 2e-3})
        for (unsigned seed = 1; seed <= of_many(15); ++seed) {
          INFO((coast ? "coast, " : "outliers, ")
               << (positions ? "x, " : "v, ") << "noise " << size << ", seed " << seed);
          SelectionOptions options;
          options.coast = coast, options.positions = positions, options.outliers = coast ? 0 : 5;
          const auto run = made_run(seed, positions, size);
          const auto kept = selected(run, options).first;
          REQUIRE(kept.size() == run.size());
          REQUIRE(std::ranges::count(kept, true) >= 60);
          REQUIRE(std::ranges::count(kept, false) >= 1);
          check(run, options, [](Sample s) { return Sample{s.t, -s.y}; });
          check(run, options, [](Sample s) { return Sample{ms * s.t, s.y}; });
          check(run, options, [](Sample s) { return Sample{minutes * s.t, cm * s.y}; });
          check(run, options, [](Sample s) { return Sample{s.t, -feet * s.y}; });
          check(run, options, [](Sample s) { return Sample{s.t - 3.3, s.y}; });
          check(run, options, [](Sample s) { return Sample{s.t + 1e5, s.y}; });
          if (!positions) continue;  // a speed has no other origin
          check(run, options, [](Sample s) { return Sample{s.t, 0.9 - s.y}; });
          check(run, options, [](Sample s) { return Sample{s.t, s.y + 1000}; });
        }
}

// A roll that is seen backwards speeds up, so that only outliers have this symmetry. Of readings
// without noise they have not: their scatter is the smallest step so far.
TEST_CASE("selection: a record seen backwards has the same outliers", "[signal]") {
  SelectionOptions options;
  options.outliers = 5;
  for (const bool positions : {false, true})
    for (const double size : {1e-4, 3e-4, 2e-3})
      for (unsigned seed = 1; seed <= 40; ++seed) {
        const auto run = made_run(seed, positions, size);
        std::vector<Sample> back(run.rbegin(), run.rend());
        for (Sample& s : back) s.t = -s.t;
        auto kept = selected(back, options).first;
        std::reverse(kept.begin(), kept.end());
        INFO((positions ? "x, " : "v, ") << "noise " << size << ", seed " << seed);
        CHECK(kept == selected(run, options).first);
      }
}
