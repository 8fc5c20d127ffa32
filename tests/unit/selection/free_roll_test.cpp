// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/free_roll.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "unit/catch.h"
#include "unit/many.h"
#include "unit/normal.h"
#include "unit/signal/through.h"

using namespace rolling;

namespace {

/// Rest for 1 s, a push of 0.5 s up to 0.5 m/s, a roll that slows by 0.1 m/s^2 and stops at 6.5 s,
/// rest until 8 s.
double speed(double t) {
  return t < 1 || t > 6.5 ? 0
         : t < 1.5        ? 0.5 * std::pow(std::sin(3.14159265358979 * (t - 1)), 2)
                          : 0.1 * (6.5 - t);
}
constexpr double release = 1.5, stop = 6.5;

/// Its readings, by a clock that begins `phase` [s] later.
std::vector<Sample> made_run(double rate, double size, unsigned seed, bool positions,
                             double sign = 1, double phase = 0) {
  std::vector<Sample> run;
  double x = 0.3;
  const auto n = static_cast<std::size_t>(8 * rate);
  const Series e = noise(n, seed);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) / rate;
    if (i > 0)
      for (int k = 0; k < 20; ++k) x += speed(t + phase - (k + 0.5) / (20 * rate)) / (20 * rate);
    run.push_back({t, sign * (positions ? x : speed(t + phase)) + size * e[i]});
  }
  return run;
}

}  // namespace

TEST_CASE("free_roll: from after the push up to the stop, speeds and positions, many seeds",
          "[signal]") {
  const unsigned seeds = of_many(100);
  int beyond = 0, late = 0;
  for (const double sign : {1.0, -1.0})
    for (const double rate : {25.0, seeds == 100 ? 100.0 : 50.0})
      for (unsigned seed = 1; seed <= seeds; ++seed) {
        const auto v = made_run(rate, 0.004, seed, false, sign),
                   x = made_run(rate, 0.0004, seed, true, sign);
        for (const auto* run : {&v, &x}) {
          const auto [begin, end, first, last] = free_roll(*run, run == &x).kept;
          CAPTURE(run == &x, rate, seed, (*run)[begin].t, (*run)[end - 1].t);
          CHECK((*run)[begin].t >= release - 0.01);  // where the push has faded: below the noise
          late += (*run)[begin].t >= release + 1;
          CHECK((*run)[end - 1].t <= stop + 4 / rate);
          beyond += (*run)[end - 1].t > stop + 2 / rate;
          CHECK((*run)[end - 1].t > stop - 0.8);
        }
      }
  // Of 800 runs at most 5 and 4, of 160 as many as lie 2.5 standard deviations above.
  CHECK(beyond <= (seeds == 100 ? 5 : 2));
  CHECK(late <= (seeds == 100 ? 4 : 2));
}

TEST_CASE(
    "free_roll: a run that begins with the roll keeps its beginning, one that ends in it its "
    "end",
    "[signal]") {
  const auto run = made_run(25, 0, 1, false);
  const std::span<const Sample> whole(run);
  const auto begins = free_roll(whole.subspan(40), false).kept;
  CHECK(begins.begin == 0);
  const auto ends = free_roll(whole.subspan(0, 100), false).kept;
  CHECK(ends.end == 100);
  const auto fine = made_run(500, 0, 1, false);  // means of several runs are searched first
  for (const std::size_t n : {1999U, 2000U, 2001U, 2002U}) {
    INFO(n << " runs");
    const auto all = free_roll(std::span(fine).subspan(800, n), false).kept;
    CHECK((all.begin == 0 && all.end == n));
  }
}

// Else the runs that are kept would be chosen by their noise, and a and b biased.
TEST_CASE("free_roll: other noise of the last runs that are kept does not move the end",
          "[signal]") {
  for (const bool positions : {false, true}) {
    unsigned moved = 0;
    for (unsigned seed = 1; seed <= of_many(200); ++seed) {
      auto run = made_run(25, positions ? 0.0004 : 0.004, seed, positions);
      const auto other = made_run(25, positions ? 0.0004 : 0.004, seed + 1000, positions);
      const std::size_t end = free_roll(run, positions).kept.end;
      std::copy_n(&other[end - 5], 5, &run[end - 5]);
      const std::size_t again = free_roll(run, positions).kept.end;
      moved += std::max(end, again) - std::min(end, again) > 2;
    }
    CAPTURE(positions);
    CHECK(moved <= at_most(of_many(200), 0.06));
  }
}

TEST_CASE("free_roll: under the drag of air one law has more than one parabola of speeds",
          "[signal]") {
  // A bicycle by a satellite receiver: v' = -(A + B v^2), so that the deceleration falls from 0.5
  // to 0.06 m/s^2 in one roll, which ends at (atan(v0 sqrt(B/A)))/sqrt(A B).
  constexpr double A = 0.06, B = 0.0045, v0 = 10, begin = 30;
  const double root = std::sqrt(A * B), stop_time = std::atan(v0 * std::sqrt(B / A)) / root;
  int whole = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const Series e = noise(120, seed);
    std::vector<Sample> run;
    for (std::size_t i = 0; i < 120; ++i) {
      const double t = static_cast<double>(i), s = t - begin,
                   v = s > 0    ? std::sqrt(A / B) * std::tan(root * std::max(0.0, stop_time - s))
                       : t > 22 ? v0
                       : t > 8  ? v0 * std::pow(std::sin(3.14159265358979 * (t - 8) / 28), 2)
                                : 0;
      run.push_back({t, v == 0 ? 0 : std::round((v + 0.055 * e[i]) * 36) / 36});
    }
    const auto [from, to, first, last] = free_roll(run, false).kept;
    INFO("seed " << seed << ": " << run[from].t << " to " << run[to - 1].t);
    CHECK(run[from].t >= begin - 1);
    CHECK(run[to - 1].t <= begin + stop_time + 2);
    whole += run[to - 1].t - run[from].t > 0.8 * stop_time;
  }
  CHECK(whole >= 90);
}

TEST_CASE("free_roll: a deceleration that grows up to the stop is of one roll", "[signal]") {
  // v' = -c v^b with b < 0, so that v = v0 (1 - s/T)^(1/(1 - b)), behind the push of made_run.
  constexpr double T = 10;
  for (const double b : {-0.5, -1.0, -2.0}) {
    int whole = 0;
    for (unsigned seed = 1; seed <= 50; ++seed) {
      const Series e = noise(625, seed);
      std::vector<Sample> run;
      for (std::size_t i = 0; i < e.size(); ++i) {
        const double t = static_cast<double>(i) / 50, s = (t - release) / T,
                     v = s < 0   ? speed(t)
                         : s < 1 ? 0.5 * std::pow(1 - s, 1 / (1 - b))
                                 : 0;
        run.push_back({t, v + 0.001 * e[i]});
      }
      const auto [from, to, first, last] = free_roll(run, false).kept;
      whole += run[from].t > release - 0.01 && run[to - 1].t < release + T + 0.08 &&
               run[to - 1].t - run[from].t > 0.8 * T;
    }
    INFO("b " << b);
    CHECK(whole >= 45);
  }
}

TEST_CASE("free_roll: readings that a logger held count once", "[signal]") {
  // Rest, a push of 0.4 s from 1 s on, a roll that slows by 0.28 m/s^2 from 0.5 m/s, rest;
  // positions every 80 ms, which stand in four rows each.
  int right = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const Series e = noise(250, seed);
    std::vector<Sample> run;
    for (std::size_t i = 0; i < 250; ++i) {
      const double t = 0.02 * static_cast<double>(i), of = 0.08 * static_cast<double>(i / 4),
                   pushed = std::clamp(of - 1, 0.0, 0.4),
                   rolled = std::clamp(of - 1.4, 0.0, 0.5 / 0.28);
      run.push_back(
          {t, 0.3 + 0.625 * pushed * pushed + rolled * (0.5 - 0.14 * rolled) + 3e-4 * e[i / 4]});
    }
    const auto [from, to, first, last] = free_roll(run, true).kept;
    INFO("seed " << seed << ": " << run[from].t << " to " << run[to - 1].t);
    CHECK(run[from].t >= 1.3);
    CHECK(run[to - 1].t <= 3.4);
    right += run[to - 1].t - run[from].t > 1.2;
  }
  CHECK(right >= 48);
}

namespace {

/// made_run, of which a hand takes hold at `caught` and stops it within `in` seconds.
std::vector<Sample> caught_run(double caught, double in, unsigned seed, bool positions,
                               double phase) {
  auto run = made_run(25, positions ? 3e-4 : 2e-3, seed, positions, 1, phase);
  for (Sample& s : run)
    if (const double t = s.t + phase; t > caught) {
      const double u = std::min(t - caught, in), v = speed(caught), pi = std::acos(-1),
                   moved = v * (u + in / pi * std::sin(pi * u / in)) / 2,
                   now = v * (1 + std::cos(pi * u / in)) / 2, left = stop - t;
      s.y += positions ? moved - v * v / 0.2 + (left > 0 ? 0.05 * left * left : 0) : now - speed(t);
    }
  return run;
}

}  // namespace

TEST_CASE("free_roll: a slow body that a hand stops does not end by itself", "[signal]") {
  // At a tenth of its speed, within 0.2 s.
  constexpr double caught = 6;
  unsigned by_itself = 0, is_ended = 0;
  for (unsigned seed = 1; seed <= 100; ++seed)
    for (const bool positions : {true, false}) {
      const double phase = seed / 2500.;  // of the clock, so that the stop lies between readings
      const auto natural = made_run(25, positions ? 3e-4 : 2e-3, seed, positions, 1, phase),
                 hand = caught_run(caught, 0.2, seed, positions, phase);
      by_itself += free_roll(natural, positions).how == FreeRoll::End::by_itself;
      const auto [kept, how, after, speed, other] = free_roll(hand, positions);
      if (how != FreeRoll::End::is_ended) continue;
      ++is_ended;
      CHECK(hand[kept.end - 1].t + phase < caught + 0.06);
    }
  CHECK(by_itself == 200);
  CHECK(is_ended >= 190);
}

TEST_CASE("free_roll: a hand that slows a body by little more than its friction is not kept",
          "[signal]") {
  constexpr double caught = 5.9;  // 0.6 s before the stop
  for (const bool positions : {true, false})
    for (const double in : {0.6, 0.7}) {
      unsigned with_hand = 0;
      for (unsigned seed = 1; seed <= 100; ++seed) {
        const double phase = seed / 2500.;
        const auto run = caught_run(caught, in, seed, positions, phase);
        const double end = run[free_roll(run, positions).kept.end - 1].t + phase;
        CHECK(end > caught - 1);
        with_hand += end > caught + 0.1;
      }
      INFO("positions " << positions << ", within " << in << " s: " << with_hand);
      CHECK(with_hand <= 5);
    }
}

// A step tells the place of the body: an end at a step would bias the last position by half of it.
TEST_CASE("free_roll: positions to whole centimetres end amid equal readings", "[signal]") {
  double sum = 0;
  constexpr unsigned runs = 100;
  for (unsigned seed = 1; seed <= runs; ++seed) {
    const auto truth = made_run(50, 0.0003, seed, true);
    auto run = truth;
    const double grid = 0.01, origin = 1e-4 * seed;  // steps at other places
    for (Sample& s : run) s.y = grid * std::round((s.y + origin) / grid) - origin;
    const std::size_t last = free_roll(run, true).kept.end - 1;
    sum += (run[last].y - truth[last].y) / grid;
  }
  CHECK(std::abs(sum / runs) < 0.1);
}

TEST_CASE("free_roll: without noise the roll ends where the speed is 0", "[signal]") {
  const auto run = made_run(25, 0, 1, false);
  const auto [begin, end, first, last] = free_roll(run, false).kept;
  CHECK(std::abs(run[end - 1].t - stop) < 0.13);  // two rows are spared
  CHECK(run[end - 1].y > 0);
  CHECK(begin > 38);
}

// v' = -c v^b, whose acceleration falls to 0 with the speed where b > 0.
TEST_CASE("free_roll: a run without noise that ends at the stop keeps its end", "[signal]") {
  for (const double b : {0.0244, 0.215, 0.5})
    for (const double dt : {0.01, 0.02, 0.04})
      for (const bool positions : {false, true}) {
        std::vector<Sample> run;
        for (std::size_t i = 0; i <= static_cast<std::size_t>(std::round(3 / dt)); ++i) {
          const double left = std::max(0.0, 3 - dt * static_cast<double>(i)), k = 1 / (1 - b);
          run.push_back({3 - left, positions ? 0.2 * (3 - std::pow(left, k + 1)) / (k + 1)
                                             : 0.2 * std::pow(left, k)});
        }
        const auto [begin, end, first, last] = free_roll(run, positions).kept;
        INFO("b " << b << ", dt " << dt << ", positions " << positions);
        CHECK(begin == 0);
        CHECK(end + 6 >= run.size());
      }
}

TEST_CASE("free_roll: the noise is that of the moving body, however still a long rest is",
          "[signal]") {
  // The speed is four times the noise 0.8 s before the stop, and twice that of a mean of 5 runs
  // 0.18 s before it.
  double end = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Series e = noise(600, seed);
    std::vector<Sample> run;
    for (std::size_t i = 0; i < 600; ++i) {
      const double t = static_cast<double>(i) / 25, v = speed(t);
      run.push_back({t, v > 0 ? v + 0.02 * e[i] : 0});
    }
    end += run[free_roll(run, false).kept.end - 1].t / 20;
  }
  CHECK(end < stop - 0.18);
  CHECK(end > stop - 0.5);
}

TEST_CASE("free_roll: a short roll in a long rest, stopped by hand", "[signal]") {
  // Pushed from 2 s to 2.8 s, slowed by 0.25 m/s^2 for 0.9 s, stopped within 0.1 s, at 20 Hz.
  const auto v = [](double t) {
    if (t < 2 || t > 3.8) return 0.0;
    if (t < 2.8) return 0.5 * std::pow(std::sin(3.14159265358979 * (t - 2) / 1.6), 2);
    return t < 3.7 ? 0.5 - 0.25 * (t - 2.8) : 0.275 * (3.8 - t) / 0.1;
  };
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const Series e = noise(110, seed);
    std::vector<Sample> run;
    double x = 0;
    for (std::size_t i = 0; i < 110; ++i) {
      const double t = 0.05 * static_cast<double>(i);
      for (int k = 0; k < 20; ++k) x += v(t - 0.05 + 0.0025 * (k + 0.5)) * 0.0025;
      run.push_back({t, x + 0.0003 * e[i]});
    }
    const auto [begin, end, first, last] = free_roll(run, true).kept;
    INFO(seed << ": " << run[begin].t << " to " << run[end - 1].t);
    CHECK(run[begin].t > 2.79);
    CHECK(run[begin].t < 3.4);
    CHECK(run[end - 1].t > 3.5);
    CHECK(run[end - 1].t <= 3.8);
  }
}

TEST_CASE("free_roll: rest, noise alone and a handful of runs have none", "[signal]") {
  std::vector<Sample> run;
  for (const double y : Series(100, 0)) run.push_back({static_cast<double>(run.size()), y});
  CHECK_THROWS_AS(free_roll(run, false), Error);
  CHECK_THROWS_AS(free_roll(run, true), Error);
  CHECK_THROWS_AS(free_roll(std::span(run).subspan(0, 9), false), Error);
  for (const std::size_t n : {30u, 100u, 500u})
    for (unsigned seed = 1; seed <= 100; ++seed) {
      const Series e = noise(n, seed);
      run.clear();
      for (std::size_t i = 0; i < n; ++i) run.push_back({static_cast<double>(i), 0.004 * e[i]});
      for (const bool positions : {false, true}) CHECK_THROWS_AS(free_roll(run, positions), Error);
    }
}

TEST_CASE("free_roll: a run that begins in mid-roll keeps its beginning, with noise too",
          "[signal]") {
  int kept = 0;
  for (unsigned seed = 1; seed <= 100; ++seed)
    for (const bool positions : {false, true}) {
      const auto run = made_run(25, positions ? 0.0004 : 0.008, seed, positions);
      kept += free_roll(std::span(run).subspan(45), positions).kept.begin == 0;
    }
  CHECK(kept >= 198);
}

TEST_CASE("free_roll: a reading that does not belong is no push", "[signal]") {
  for (const double wrong : {0.0, -0.5, 0.45}) {
    auto run = made_run(25, 0.004, 3, false);
    run[100].y = wrong;
    CHECK(run[free_roll(run, false).kept.begin].t < release + 1);
  }
}

TEST_CASE("free_roll: one reading that is off, wherever it is, moves no end but beside it",
          "[signal]") {
  for (const bool positions : {false, true})
    for (const double off : {0.2, -0.02}) {
      const auto good = made_run(25, positions ? 3e-4 : 2e-3, 5, positions);
      const Stretch whole = free_roll(good, positions).kept;
      for (std::size_t at = 1; at + 1 < good.size(); at += 5 / of_many(5)) {
        auto run = good;
        run[at].y += off;
        const Stretch kept = free_roll(run, positions).kept;
        const auto moved = [&](std::size_t end, std::size_t without) {
          const auto rows = [](std::size_t a, std::size_t b) { return a > b ? a - b : b - a; };
          CHECK(rows(end, without) <=
                (rows(at, without) < 11 ? 8 : 2));  // 11: a window of Outliers
        };
        INFO("positions " << positions << ", " << off << " at " << at);
        moved(kept.begin, whole.begin);
        moved(kept.end, whole.end);
      }
    }
}

TEST_CASE("free_roll: the units of time and readings change nothing", "[signal]") {
  const std::vector<std::pair<int, int>> powers{{0, -900},   {0, -560},  {0, 560}, {0, 900},
                                                {-900, 0},   {-300, 0},  {300, 0}, {900, 0},
                                                {500, -500}, {-600, 600}};
  InTurn in_turn;
  for (const bool positions : {false, true})
    for (const double rate : {25.0, 5000.0}) {  // 5000: means of several runs are searched first
      const auto run = made_run(rate, positions ? 0.0004 : 0.004, 1, positions);
      const FreeRoll expected = free_roll(run, positions);
      for (const auto& [of_t, of_y] : powers) {
        if (!in_turn()) continue;
        std::vector<Sample> scaled = run;
        for (Sample& s : scaled) s = {std::ldexp(s.t, of_t), std::ldexp(s.y, of_y)};
        const FreeRoll found = free_roll(scaled, positions);
        INFO((positions ? "x, " : "v, ") << rate << " Hz, 2^" << of_t << ", 2^" << of_y);
        CHECK(found.kept.begin == expected.kept.begin);
        CHECK(found.kept.end == expected.kept.end);
        CHECK(found.how == expected.how);
        CHECK(found.after == std::ldexp(expected.after, of_t));
        CHECK(found.other.has_value() == expected.other.has_value());
      }
    }
}
