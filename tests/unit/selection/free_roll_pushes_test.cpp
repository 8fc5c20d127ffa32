// SPDX-License-Identifier: GPL-3.0-or-later
// What pushes, holds, hands and sensors do to the ends of the free roll.
#include "selection/free_roll.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "unit/catch.h"
#include "unit/normal.h"
#include "unit/signal/through.h"
#include "unit/many.h"

using namespace rolling;

namespace {

/// Speeds of a body that is pushed to 0.5 m/s within 0.4 s from 1 s on, held at that speed, and let
/// go; it slows by 0.1 m/s^2, and is pushed once more, to 0.45 m/s, when it is as slow as `again`.
struct Driven {
  std::vector<Sample> run;
  double release = 0;
};
Driven driven(double hold, double again, unsigned seed) {
  const Series e = noise(2000, seed);
  Driven made;
  double v = 0, pushed_at = again > 0 ? -1 : 0;
  for (std::size_t i = 0; i < e.size() && (i < 60 || v > 0); ++i) {
    const double t = 0.04 * static_cast<double>(i);
    if (t < 1.4 + hold) {
      v = t < 1 ? 0 : t < 1.4 ? 0.5 * std::pow(std::sin(3.14159265358979 / 0.8 * (t - 1)), 2) : 0.5;
      made.release = t;
    } else if (pushed_at < 0 && v < again) {
      pushed_at = t;
    } else if (pushed_at > 0 && v < 0.45 && t < pushed_at + 0.4) {
      v = std::min(0.45, v + 0.04), made.release = t;
    } else {
      v = std::max(0.0, v - 0.004);
    }
    made.run.push_back({t, v + 0.004 * e[i]});
  }
  return made;
}

}  // namespace

TEST_CASE("free_roll: it begins after the last push or hold", "[signal]") {
  for (const double hold : {0.0, 3.0, 10.0})
    for (const double again : {0.0, 0.2, 0.3}) {
      int right = 0;
      for (unsigned seed = 1; seed <= 40; ++seed) {
        const Driven made = driven(hold, again, seed);
        const double late = made.run[free_roll(made.run, false).kept.begin].t - made.release;
        right += late > 0.04 && late < 0.8;
      }
      INFO("held for " << hold << " s, pushed again at " << again << " m/s");
      CHECK(right >= 38);
    }
}

// Behind the release lies what a push leaves unseen. If the roll began at the reading behind the
// joint, and not half-way before it, this would be 4.7 readings on average.
TEST_CASE("free_roll: positions are kept from soon after the release", "[signal]") {
  double lost = 0;
  constexpr unsigned runs = 200;
  for (unsigned seed = 1; seed <= runs; ++seed) {
    const Series e = noise(100, seed);
    const double release = 1 + 1e-4 * seed;  // after a push of 0.3 s to 0.5 m/s
    std::vector<Sample> run;
    for (const double of_noise : e) {
      const double t = 0.04 * static_cast<double>(run.size()), since = t - release,
                   pushed = std::clamp(1 + since / 0.3, 0.0, 1.0);
      run.push_back({t, 3e-4 * of_noise + (since < 0 ? 0.075 * (pushed * pushed - 1)
                                                     : since * (0.5 - 0.04 * since))});
    }
    const double late = (run[free_roll(run, true).kept.begin].t - release) / 0.04;
    CHECK(late > 0);
    lost += late / runs;
  }
  CHECK(lost < 4.3);
}

namespace {

/// A run with a known release: rest for 1 s, a push of 0.4 s to 0.5 m/s, a hold, a roll under
/// v' = -c v^b which would last `roll` seconds from 0.5 m/s, once more a push by 0.15 m/s when it
/// is as slow as `again`, and rest for 1 s; or the roll alone, from its middle.
struct Made {
  double hold = 0, again = 0;
  bool middle = false;
  double b = 0.215, roll = 2.5, rate = 25;
  double noise = 3e-4, resolution = 1e-3;  ///< of positions [m]
  bool positions = true;  ///< else the speeds that a sensor takes from four of its positions

  std::vector<Sample> run = {};
  double release = 0, stop = 0;

  void make(unsigned seed) {
    constexpr int steps = 40;
    const double h = 1 / (rate * steps), c = std::pow(0.5, 1 - b) / (roll * (1 - b));
    std::mt19937_64 random(seed);
    Normal any;
    std::vector<double> x;
    double at = 0.3, v = middle ? 0.5 : 0, since = 1;
    enum { rest, push, held, pushed_again, free, stopped } now = middle ? free : rest;
    bool due = again > 0;
    for (int i = 0; now != stopped || i * h < stop + 1; ++i, at += v * h) {
      const double t = i * h, past = t - since;
      if (i % steps == 0) {
        const double y = at + noise * any(random);
        x.push_back(resolution > 0 ? resolution * std::round(y / resolution) : y);
      }
      if (now == rest && past >= 0) now = push;
      if (now == push) v = 0.5 * std::pow(std::sin(3.14159265358979 / 0.8 * past), 2);
      if (now == push && past >= 0.4) now = held, v = 0.5;
      if (now == held && past >= 0.4 + hold) now = free, release = t;
      if (now == free && due && v < again) now = pushed_again, since = t, due = false;
      if (now == pushed_again)
        v = again + 0.15 * std::pow(std::sin(3.14159265358979 / 0.8 * (t - since)), 2);
      if (now == pushed_again && t - since >= 0.4) now = free, release = t;
      if (now == free) v -= h * c * std::pow(v, b);
      if (now == free && !(v > 0)) now = stopped, stop = t, v = 0;
    }
    run.clear();
    for (std::size_t i = 2; i + 2 < x.size(); ++i)
      run.push_back({static_cast<double>(i) / rate,
                     positions ? x[i] : (x[i + 1] + x[i + 2] - x[i - 1] - x[i - 2]) * rate / 6});
  }

  /// The roll that is kept begins at most 0.1 s before the release, as the push fades and loses no
  /// more than a quarter of the roll, or 0.8 s; it ends at most 4 runs after the stop.
  bool right(const Stretch& kept) const {
    const double late = run[kept.begin].t - release;
    return (middle ? kept.begin < 3 : late > -0.1 && late < std::max(0.8, roll / 4)) &&
           run[kept.end - 1].t < stop + 4 / rate && run[kept.end - 1].t > stop - 0.4 * roll;
  }
};

}  // namespace

TEST_CASE("free_roll: pushes, holds, noise and rounding: right, or told to be in doubt",
          "[signal]") {
  std::vector<Made> kinds;
  for (const double hold : {0.0, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0}) kinds.push_back({.hold = hold});
  for (const double again : {0.2, 0.3}) kinds.push_back({.again = again});
  kinds.push_back({.middle = true});
  constexpr double noises[][2] = {{3e-4, 0}, {5e-4, 0}, {1e-3, 0}, {3e-4, 1e-3}, {1e-3, 1e-3}};
  constexpr double laws[][2] = {{0.215, 2.5}, {0.0244, 6}, {0.255, 3.4}, {0.5, 5}};
  unsigned seed = 7000;
  InTurn in_turn;
  int told_of_good = 0, good = 0;
  for (Made& made : kinds) {
    int runs = 0, right = 0, told = 0;
    for (const auto& [noise, resolution] : noises)
      for (const auto& [b, roll] : laws)
        for (const bool positions : {true, false})
          for (const double rate : {25.0, 50.0}) {
            ++seed;
            if (!in_turn()) continue;
            made.b = b, made.roll = roll, made.rate = rate, made.positions = positions;
            made.noise = noise, made.resolution = resolution;
            made.make(seed);
            ++runs;
            const bool usual = made.hold + made.again == 0 && noise <= 5e-4 && resolution <= 1e-3;
            good += usual;
            try {
              const auto [kept, how, after, speed, other] = free_roll(made.run, positions);
              right += made.right(kept);
              told += !made.right(kept) && other;
              told_of_good += usual && other;
            } catch (const Error&) {
              ++told;
            }
          }
    INFO("hold " << made.hold << " s, again at " << made.again << " m/s, middle " << made.middle
                 << ": of " << runs << " right " << right << ", told " << told);
    CHECK(100 * (right + told) >= 90 * runs);
    CHECK(100 * right >= 85 * runs);
  }
  INFO("told of " << told_of_good << " of " << good);
  CHECK(25 * told_of_good <= good);
}

// A reading then stays the same for many runs, so that its rounding errors follow each other.
TEST_CASE("free_roll: fast sensors whose noise is below their resolution", "[signal][many]") {
  unsigned seed = 1;
  InTurn in_turn;
  for (const double rate : {1000.0, 5000.0})
    for (const double resolution : {1e-3, 1e-4})
      for (const double noise : {0.0, 3e-5})
        for (const auto& [b, roll] :
             {std::pair{0.0244, 10.0}, {0.0244, 6.8}, {0.215, 2.4}, {0.255, 3.4}})
          for (const bool positions : {true, false}) {
            ++seed;
            if (!in_turn()) continue;
            Made made{.b = b,
                      .roll = roll,
                      .rate = rate,
                      .noise = noise,
                      .resolution = resolution,
                      .positions = positions};
            made.make(seed);
            const Stretch kept = free_roll(made.run, positions).kept;
            INFO("rate " << rate << " resolution " << resolution << " noise " << noise << " b " << b
                         << " positions " << positions << ": from "
                         << made.run[kept.begin].t - made.release << " s to "
                         << made.run[kept.end - 1].t - made.stop << " s");
            CHECK(made.right(kept));
            CHECK(made.run[kept.end - 1].t > made.stop - 0.25 * roll);
          }
}

TEST_CASE("free_roll: a long run keeps what a short one keeps", "[signal]") {
  // 4e5 runs of 10 kHz; those of 25 Hz of the same motion begin and end within two of theirs.
  Made fine{.hold = 1, .b = 0.5, .roll = 36, .rate = 10000, .noise = 1e-3, .resolution = 0};
  fine.make(1);
  const Stretch kept = free_roll(fine.run, true).kept;
  CHECK(fine.run[kept.begin].t > fine.release);
  CHECK(fine.run[kept.begin].t < fine.release + 0.5);
  CHECK(fine.run[kept.end - 1].t < fine.stop);
  CHECK(fine.right(kept));
  // The same rest for ten times as long: the roll is sought again in a part of the run.
  std::vector<Sample> longer;
  const double before = 400;
  for (std::size_t i = 0; i < 4'000'000; ++i)
    longer.push_back({static_cast<double>(i) / 1e4 - before, fine.run[i % 9000].y});
  longer.insert(longer.end(), fine.run.begin(), fine.run.end());
  const Stretch again = free_roll(longer, true).kept;
  CHECK(std::abs(longer[again.begin].t - fine.run[kept.begin].t) < 0.15);
  CHECK(std::abs(longer[again.end - 1].t - fine.run[kept.end - 1].t) < 2);
}

// A class pushes its body to and fro: a push of 0.4 s to 0.5 m/s, a roll that slows by 0.1 m/s^2
// for 2 s, a hand that stops the body within 0.2 s, rest for 0.6 s, the same backwards, ...
TEST_CASE("free_rolls: every roll of a record is found, and no hand", "[signal]") {
  constexpr double period = 3.2;
  constexpr int times = 6;
  int found = 0;
  int wrong = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Series e = noise(25 * 20, seed);
    std::vector<Sample> run;
    for (const double of_noise : e) {
      const double t = 0.04 * static_cast<double>(run.size());
      const double past = std::fmod(t, period);
      double v = 0;
      if (past < 0.4) v = 0.5 * std::pow(std::sin(3.14159265358979 / 0.8 * past), 2);
      else if (past < 2.4) v = 0.5 - 0.1 * (past - 0.4);
      else if (past < 2.6) v = 0.3 * (2.6 - past) / 0.2;
      const bool back = static_cast<int>(t / period) % 2 == 1;
      run.push_back({t, (back ? -v : v) + 0.004 * of_noise});
    }
    for (const FreeRoll& roll : free_rolls(run, false)) {
      const double from = std::fmod(roll.kept.from, period);
      const bool right = from > 0.3 && from + roll.kept.to - roll.kept.from < 2.5;
      found += right && roll.kept.to - roll.kept.from > 1.2;
      wrong += !right;
    }
  }
  CHECK(100 * found >= 95 * times * 20);
  CHECK(100 * wrong <= times * 20);
}

namespace {

/// Positions at 25 Hz to a millimetre: rest, and rolls that slow down by these, with rests between.
std::vector<Sample> rolls_of(std::span<const double> decelerations, std::size_t rest,
                             unsigned seed) {
  std::vector<double> x(50, 0.5);
  constexpr double dt = 0.04;
  double way = 1;
  for (const double of_roll : decelerations) {
    for (int i = 1; i <= 10; ++i) x.push_back(x.back() + way * 0.45 * i / 10 * dt);
    for (double v = 0.45; v > 0; v -= of_roll * dt) x.push_back(x.back() + way * v * dt);
    x.insert(x.end(), rest, x.back());
    way = -way;
  }
  const Series e = noise(x.size(), seed);
  std::vector<Sample> run;
  for (std::size_t i = 0; i < x.size(); ++i)
    run.push_back({dt * static_cast<double>(i), 1e-3 * std::round(1e3 * x[i] + 0.3 * e[i])});
  return run;
}

}  // namespace

// A cylinder on felt, to and fro on a mat that is not level: the slope is a third of D/R at most.
TEST_CASE("free_rolls: up and down a slope are rolls of one body", "[signal]") {
  for (const double share : {0.0, 0.1, 0.2, 0.3})
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const double up = 0.094 * (1 + share);
      const double down = 0.094 * (1 - share);
      CAPTURE(share, seed);
      CHECK(free_rolls(rolls_of(std::vector{up, down, up, down}, 40, seed), true).size() == 4);
    }
}

// A mean over as many rows as the search of a long record takes would be half a second.
TEST_CASE("free_rolls: two rolls are found in ten minutes of rest", "[signal]") {
  for (const std::size_t rest : {500U, 3000U, 7000U})
    for (unsigned seed = 1; seed <= of_many(5); ++seed) {
      CAPTURE(rest, seed);
      const auto run = rolls_of(std::vector{0.25, 0.25}, rest, seed);
      const auto rolls = free_rolls(run, true);
      REQUIRE(rolls.size() == 2);
      for (const FreeRoll& roll : rolls) CHECK(roll.how == FreeRoll::End::by_itself);
      CHECK(rolls[0].kept.from > 2.35);
      CHECK(rolls[0].kept.from < 2.6);
      CHECK(rolls[0].kept.to == Approx(4.2).margin(0.2));
      CHECK(free_roll(run, true).how == FreeRoll::End::by_itself);
    }
}
