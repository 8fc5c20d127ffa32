#include "signal/free_roll.h"

#include <cmath>

#include "base/error.h"
#include "unit/catch.h"
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

std::vector<Sample> record(double rate, double size, unsigned seed, bool positions,
                           double sign = 1) {
  std::vector<Sample> run;
  double x = 0.3;
  const auto n = static_cast<std::size_t>(8 * rate);
  const Series e = noise(n, seed);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) / rate;
    if (i > 0)
      for (int k = 0; k < 20; ++k) x += speed(t - (k + 0.5) / (20 * rate)) / (20 * rate);
    run.push_back({t, sign * (positions ? x : speed(t)) + size * e[i]});
  }
  return run;
}

}  // namespace

TEST_CASE("free_roll: from after the push up to the stop, speeds and positions, many seeds",
          "[signal]") {
  int beyond = 0;  // a mean at rest is above twice its noise in 2 % of cases
  for (const double sign : {1.0, -1.0})
    for (const double rate : {25.0, 100.0})
      for (unsigned seed = 1; seed <= 100; ++seed) {
        const auto v = record(rate, 0.004, seed, false, sign),
                   x = record(rate, 0.0004, seed, true, sign);
        for (const auto* run : {&v, &x}) {
          const auto [begin, end] = free_roll(*run, run == &x);
          INFO((run == &x ? "x " : "v ") << rate << " Hz, seed " << seed << ": " << (*run)[begin].t
                                         << " to " << (*run)[end - 1].t);
          CHECK((*run)[begin].t >=
                release + 1.9 / rate);  // a derivative over two samples knows nothing of the push
          CHECK((*run)[begin].t < release + 1);
          CHECK((*run)[end - 1].t <= stop + 4 / rate);
          beyond += (*run)[end - 1].t > stop + 2 / rate;
          CHECK((*run)[end - 1].t > stop - 0.8);
        }
      }
  CHECK(beyond <= 16);  // of 800
}

TEST_CASE(
    "free_roll: a record that begins with the roll keeps its beginning, one that ends in it its "
    "end",
    "[signal]") {
  const auto run = record(25, 0, 1, false);
  const std::span<const Sample> whole(run);
  const auto begins = free_roll(whole.subspan(40), false);
  CHECK(begins.begin == 0);
  const auto ends = free_roll(whole.subspan(0, 100), false);
  CHECK(ends.end == 100);
}

TEST_CASE("free_roll: without noise the roll ends where the speed is 0", "[signal]") {
  const auto run = record(25, 0, 1, false);
  const auto [begin, end] = free_roll(run, false);
  CHECK(std::abs(run[end - 1].t - stop) < 0.09);
  CHECK(run[end - 1].y > 0);
  CHECK(begin > 38);
}

TEST_CASE("free_roll: the noise is that of the moving body, however still a long rest is",
          "[signal]") {
  // Means of 5 records at 25 Hz have the noise 0.02/sqrt(5): the speed is twice that 0.18 s before
  // the stop.
  double end = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Series e = noise(600, seed);
    std::vector<Sample> run;
    for (std::size_t i = 0; i < 600; ++i) {
      const double t = static_cast<double>(i) / 25, v = speed(t);
      run.push_back({t, v > 0 ? v + 0.02 * e[i] : 0});
    }
    end += run[free_roll(run, false).end - 1].t / 20;
  }
  CHECK(end < stop - 0.18);
  CHECK(end > stop - 0.4);
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
    const auto [begin, end] = free_roll(run, true);
    INFO(seed << ": " << run[begin].t << " to " << run[end - 1].t);
    CHECK(run[begin].t > 2.85);
    CHECK(run[begin].t < 3.4);
    CHECK(run[end - 1].t > 3.5);
    CHECK(run[end - 1].t <= 3.8);
  }
}

TEST_CASE("free_roll: rest, noise alone and a handful of records have none", "[signal]") {
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
        const double late = made.run[free_roll(made.run, false).begin].t - made.release;
        right += late > 0.04 && late < 0.8;
      }
      INFO("held for " << hold << " s, pushed again at " << again << " m/s");
      CHECK(right >= 38);
    }
}

TEST_CASE("free_roll: a record that begins in mid-roll keeps its beginning, with noise too",
          "[signal]") {
  int kept = 0;
  for (unsigned seed = 1; seed <= 100; ++seed)
    for (const bool positions : {false, true}) {
      const auto run = record(25, positions ? 0.0004 : 0.008, seed, positions);
      kept += free_roll(std::span(run).subspan(45), positions).begin == 0;
    }
  CHECK(kept >= 198);
}

TEST_CASE("free_roll: a reading that does not belong is no push", "[signal]") {
  for (const double wrong : {0.0, -0.5, 0.45}) {
    auto run = record(25, 0.004, 3, false);
    run[100].y = wrong;
    CHECK(run[free_roll(run, false).begin].t < release + 1);
  }
}
