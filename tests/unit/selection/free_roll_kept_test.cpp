// SPDX-License-Identifier: GPL-3.0-or-later
// Which rows are kept of smoothed readings, of pushes that fade, and of bodies that are driven on.
#include "selection/free_roll.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "base/error.h"
#include "unit/catch.h"
#include "unit/kind_of_error.h"
#include "unit/many.h"
#include "unit/signal/through.h"

using namespace rolling;

// Rest for 1 s, a push of 0.5 s up to 0.5 m/s, a roll that slows by 0.1 m/s^2, rest from 6.5 s on;
// means of 3 and of 11 rows, as programs smooth speeds: their errors follow one another.
TEST_CASE("free_roll: smoothed speeds are kept as a whole", "[signal]") {
  constexpr double release = 1.5, stop = 6.5;
  for (const std::size_t rows : {3U, 11U}) {
    int whole = 0;
    for (unsigned seed = 1; seed <= 40; ++seed) {
      const Series e = noise(400, seed);
      Series v;
      std::vector<Sample> run;
      for (std::size_t i = 0; i < e.size(); ++i) {
        const double t = 0.02 * static_cast<double>(i);
        double speed = 0;
        if (t > 1) speed = 0.5 * std::pow(std::sin(3.14159265358979 * (t - 1)), 2);
        if (t > release) speed = std::max(0.0, 0.1 * (stop - t));
        v.push_back(speed + 0.01 * e[i]);
        double sum = 0;
        for (std::size_t k = 0; k < rows && k < v.size(); ++k) sum += v[i - k];
        if (v.size() >= rows)
          run.push_back(
              {t - 0.01 * static_cast<double>(rows - 1), sum / static_cast<double>(rows)});
      }
      const auto kept = free_roll(run, false).kept;
      whole += kept.from > release - 0.05 && kept.from < release + 1 && kept.to > stop - 1 &&
               kept.to < stop + 0.1;
    }
    CAPTURE(rows);
    CHECK(whole >= 38);
  }
}

// It coasts and is driven again alike: a valley, which one parabola of speeds can be.
TEST_CASE("free_roll: of a symmetric valley of speeds the way down is kept", "[signal]") {
  for (const double middle : {18.0, 20.0, 25.0})
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const Series e = noise(41, seed);
      std::vector<Sample> run;
      for (const double of_noise : e) {
        const auto t = static_cast<double>(run.size());
        run.push_back({t, 4 + 0.025 * (t - middle) * (t - middle) + 0.02 * of_noise});
      }
      const FreeRoll roll = free_roll(run, false);
      CAPTURE(middle, seed, roll.kept.from, roll.kept.to);
      CHECK(roll.kept.from <= 3);
      CHECK(roll.kept.to <= middle);
      CHECK(roll.kept.to >= middle / 2);
      CHECK(roll.how == FreeRoll::End::is_ended);
    }
}

TEST_CASE("free_roll: a body that is fast in the last rows, which are equal, is not at rest",
          "[signal]") {
  std::vector<Sample> run;
  for (int i = 0; i < 60; ++i) run.push_back({1.0 * i, 80.0 - i / 3});
  CHECK(free_roll(run, false).how == FreeRoll::End::goes_on);
}

TEST_CASE("free_roll: positions that end at a tenth of the speed are not at rest", "[signal]") {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Series e = noise(112, seed);
    std::vector<Sample> run;
    for (std::size_t i = 0; i < e.size(); ++i) {
      const double t = 0.04 * static_cast<double>(i);
      run.push_back({t, t * (0.5 - 0.05 * t) + 1e-5 * e[i]});
    }
    const FreeRoll roll = free_roll(run, true);
    CAPTURE(seed, roll.kept.to);
    CHECK(roll.how == FreeRoll::End::goes_on);
  }
}

// An instrument that shows 0.02 m/s at rest, and a car whose log ends at 4 m/s.
TEST_CASE("free_roll: speeds that do not end at 0 are not at rest", "[signal]") {
  for (const double at_rest : {0.0, 0.0001, 0.005, 0.02})
    for (const unsigned seed : {1U, 2U, 3U}) {
      const Series e = noise(120, seed);
      std::vector<Sample> run;
      for (std::size_t i = 0; i < e.size(); ++i) {
        const double t = 0.04 * static_cast<double>(i);
        const double v = t < 1 ? 0 : std::max(0.0, 0.5 - 0.2 * (t - 1));
        run.push_back({t, at_rest + v + 1e-3 * e[i]});
      }
      const FreeRoll roll = free_roll(run, false);
      CAPTURE(at_rest, seed, roll.speed);
      const bool is_rest = at_rest < 0.001;
      CHECK(roll.how == (is_rest ? FreeRoll::End::by_itself : FreeRoll::End::stays));
      CHECK(std::abs(roll.speed - (is_rest ? 0 : at_rest)) < 1e-3);
    }
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
    const Series e = noise(290, seed);
    std::vector<Sample> run;
    for (std::size_t i = 0; i < e.size(); ++i) {
      const double t = 0.5 * static_cast<double>(i);
      run.push_back({t, 33 * std::exp(-t / 70) + 0.03 * e[i]});
    }
    CHECK(free_roll(run, false).how == FreeRoll::End::goes_on);
  }
}

// Means of seven of white noise swing slowly: some seconds of them may be level, and not at 0.
TEST_CASE("free_roll: a rest whose errors swing is a rest", "[signal]") {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const Series e = noise(186, seed);
    std::vector<Sample> run;
    for (std::size_t i = 0; i + 6 < e.size(); ++i) {
      const double t = 0.04 * static_cast<double>(i);
      const double v = t < 1 ? 0 : std::max(0.0, 0.5 - 0.2 * (t - 1));
      run.push_back({t, v + 0.01 * std::accumulate(&e[i], &e[i] + 7, 0.0) / 7});
    }
    CAPTURE(seed);
    CHECK(free_roll(run, false).how != FreeRoll::End::stays);
  }
}

// A push lasts 0.4 s: at low rates one position is read amid it.
TEST_CASE("free_roll: no position of the push is kept at a low rate", "[signal]") {
  for (const double rate : {3.0, 4.0, 5.0, 6.0, 8.0})
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const Series e = noise(60, seed);
      std::vector<Sample> run;
      for (std::size_t i = 0; i < e.size(); ++i) {
        const double t = (static_cast<double>(i) + 0.1 * seed) / rate;
        const double push = std::clamp(t - 1, 0.0, 0.4);
        const double since = std::clamp(t - 1.4, 0.0, 4.0);
        const double x =
            0.5 * (push - 0.4 / std::numbers::pi * std::sin(std::numbers::pi * push / 0.4)) / 2 +
            since * (0.5 - since / 16);
        run.push_back({t, x + 4e-4 * e[i]});
        if (t > 6) break;
      }
      const FreeRoll roll = free_roll(run, true);
      CAPTURE(rate, seed, roll.kept.from);
      CHECK(roll.kept.from >= 1.4);
    }
}

// Of 40,000 rows means of 40 are searched first; the search among the rows around the roll tells
// when the hand comes.
TEST_CASE("free_roll: in a long run, too, a hand is told to a few rows", "[signal]") {
  const Series e = noise(40000, 7);
  std::vector<Sample> run;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double t = 1e-3 * static_cast<double>(i);
    double v = 0;
    if (t >= 15 && t < 16.511) v = 0.8 - 0.2 * (t - 15);
    else if (t >= 16.511) v = std::max(0.0, 0.4978 - 5 * (t - 16.511));
    run.push_back({t, v + 1e-3 * e[i]});
  }
  const FreeRoll roll = free_roll(run, false);
  CAPTURE(roll.kept.from, roll.kept.to, roll.after);
  CHECK(roll.how == FreeRoll::End::is_ended);
  CHECK(std::abs(roll.after - 16.511) < 0.004);
}

// The speed of a body that is carried back rises and falls like 1 - cos: at some moment it slows
// down just as the free body does.
TEST_CASE("free_rolls: the way back in a hand is none", "[signal]") {
  unsigned wrong = 0;
  for (unsigned seed = 1; seed <= of_many(100); ++seed) {
    std::vector<double> x(25, 0.3);
    constexpr double dt = 0.04;
    const auto roll = [&](double v) {  // a ball, after a push of 0.4 s
      for (int i = 1; i < 10; ++i) x.push_back(x.back() + v * i / 10 * dt);
      for (; v > 0; v -= (0.11 + 0.05 * v) * dt) x.push_back(x.back() + v * dt);
      x.insert(x.end(), 25, x.back());
    };
    const auto carry_back = [&](std::size_t rows) {
      const double way = x[0] - x.back();
      const double begin = x.back();
      for (std::size_t i = 1; i <= rows; ++i) {
        const double part = static_cast<double>(i) / static_cast<double>(rows);
        const double turn = 2 * std::numbers::pi;
        x.push_back(begin + way * (part - std::sin(turn * part) / turn));
      }
      x.insert(x.end(), 25, x.back());
    };
    for (const std::size_t rows : {25U, 32U, 39U, 46U}) {
      roll(0.5 + 0.003 * seed);
      carry_back(rows + seed % 7);
    }
    const Series e = noise(x.size(), seed);
    std::vector<Sample> run;
    for (std::size_t i = 0; i < x.size(); ++i)
      run.push_back({dt * static_cast<double>(i), 1e-3 * std::round(1e3 * x[i] + 0.3 * e[i])});
    const std::size_t found = free_rolls(run, true).size();
    CAPTURE(seed);
    CHECK(found >= 4);
    wrong += static_cast<unsigned>(found) - 4;
  }
  CAPTURE(wrong);
  CHECK(wrong <= at_most(of_many(100), 0.02));
}

TEST_CASE("free_roll: it takes ten rows", "[signal]") {
  std::vector<Sample> run;
  for (int i = 0; i < 10; ++i) run.push_back({0.04 * i, 0.5 - 0.02 * i});
  CHECK_NOTHROW(free_roll(run, false));
  CHECK_THROWS_AS(free_roll(std::span(run).subspan(0, 9), false), Error);
}

// Before a body is driven again, its speed is held for a moment, which a parabola of the coast can
// take in. Speeds of a bicycle in km/h at 10 Hz, to 0.1 km/h.
TEST_CASE("free_roll: the speed that is held before the drive is not kept", "[signal]") {
  int right = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const Series e = noise(450, seed);
    const double held = 1 + 0.02 * seed;  // [s]
    std::vector<Sample> run;
    double coasting = 0;
    for (const double of_noise : e) {
      const double t = 0.1 * static_cast<double>(run.size());
      coasting = std::clamp(t - 8, 0.0, 25.0);
      const double drive = std::max(0.0, t - 33 - held);
      const double v = 30 - 0.7 * coasting + 0.008 * coasting * coasting + 4 * std::min(drive, 4.0);
      run.push_back({t, std::round(10 * (v + 0.15 * of_noise)) / 10});
    }
    const FreeRoll roll = free_roll(run, false);
    right += roll.kept.from > 7.85 && roll.kept.to < 33.15 && roll.kept.to - roll.kept.from > 18;
  }
  CHECK(right >= 57);
}

// Held at the speed that the coast before would have reached by then, and coasting again from
// there.
TEST_CASE("free_roll: a coast does not go on behind a drive", "[signal]") {
  const auto v = [](double t) {
    if (t < 10) return 42.0;
    if (t < 32) return 42 - 0.5 * (t - 10);
    if (t < 35) return 31 - 7 * (t - 32);
    if (t < 38) return 10 + 4.5 * (t - 35);
    if (t < 45) return 24.5;
    if (t < 72) return 24.5 - 0.5 * (t - 45);
    return 11 + 3 * (t - 72);
  };
  const Series e = noise(80, 2);
  std::vector<Sample> run;
  for (const double of_noise : e) {
    const auto t = static_cast<double>(run.size());
    run.push_back({t, std::round(10 * (v(t) + 0.05 * of_noise)) / 10});
  }
  const std::vector<FreeRoll> rolls = free_rolls(run, false);
  REQUIRE(rolls.size() == 2);
  CHECK(rolls[0].kept.to <= 32);
  CHECK(rolls[1].kept.from >= 44);
}

// Of steps of 32 and 48 ms in turn, the differences of a reading to the next ones are of times that
// differ, and those to the third are not.
TEST_CASE("free_roll: steps that alternate", "[signal]") {
  const Series e = noise(101, 3);
  std::vector<Sample> run;
  double t = 0;
  for (const double of_noise : e) {
    run.push_back({t, 0.5 - 0.08 * t + 1e-3 * of_noise});
    t += run.size() % 2 == 0 ? 0.048 : 0.032;
  }
  CHECK(free_roll(run, false).kept.end == run.size());
}

// What is left of a short roll between its uncertain ends may be nothing.
TEST_CASE("free_roll: one that is shorter than the means it is made of is refused", "[signal]") {
  for (const unsigned rows : {20U, 30U, 40U}) {
    const Series e = noise(600, rows);
    std::vector<double> v;
    for (std::size_t i = 0; i < e.size(); ++i) {
      const double past = static_cast<double>(i) - 300;
      double speed = 0;
      if (past > 0) speed = 0.1 * std::min(past, 5.0);
      if (past > 5) speed -= 0.008 * (past - 5);
      v.push_back((past < static_cast<double>(rows) ? std::max(speed, 0.0) : 0) + 3e-3 * e[i]);
    }
    std::vector<Sample> run;
    for (std::size_t i = 17; i + 17 < v.size(); ++i)
      run.push_back({0.02 * static_cast<double>(i), std::reduce(&v[i - 17], &v[i] + 18) / 35});
    CAPTURE(rows);
    CHECK(kind_of_error([&] { free_roll(run, false); }) == NoFreeRoll);
  }
}

// Among means of 20 readings it stands out; among the finer ones of a part of the run it does not.
TEST_CASE("free_roll: what a finer search does not find is not lost", "[signal]") {
  const Series e = noise(20000, 1);
  std::vector<Sample> run;
  for (const double of_noise : e) {
    const double t = 1e-3 * static_cast<double>(run.size());
    const double v = t > 2 ? std::max(0.0, 0.5 - 0.08 * (t - 2)) : 0;
    run.push_back({t, v + 0.35 * of_noise});
  }
  const FreeRoll roll = free_roll(run, false);
  CHECK(roll.kept.from > 1.8);
  CHECK(roll.kept.from < 3);
  CHECK(roll.kept.to > 7);
  CHECK(roll.kept.to < 8.5);
}
