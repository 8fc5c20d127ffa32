// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/readings.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "signal/method.h"
#include "unit/catch.h"
#include "unit/signal/through.h"

using namespace rolling;

namespace {

/// Speeds of a body that slows down by a share of its speed a second, at 25 Hz, with normal noise,
/// rounded to a unit, each held for so many rows.
Series speeds(std::size_t held, double noise_size, double unit, double slowing, unsigned seed) {
  const Series e = noise(500, seed);
  Series v;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const std::size_t from = i - i % held;
    const double now =
        5 * std::exp(-slowing * 0.04 * static_cast<double>(from)) + noise_size * e[from];
    v.push_back(unit > 0 ? std::round(now / unit) * unit : now);
  }
  return v;
}

}  // namespace

TEST_CASE("readings: those that were held are told", "[signal]") {
  int all = 0, told = 0;
  for (const std::size_t held : {2u, 5u, 25u})
    for (const double unit : {0., 0.001, 0.01})
      for (const double size : {0.001, 0.05})
        for (unsigned seed = 1; seed <= 20; ++seed) {
          if (size < 3 * unit && 0.01 * static_cast<double>(held) < 3 * unit) continue;
          ++all, told += are_held(speeds(held, size, unit, 0.1, seed));
        }
  INFO(told << " of " << all);
  CHECK(told >= 0.98 * all);  // 25 rows each of 500 are 20 readings
}

// A sensor of 10 or 7 Hz in a log of 25 Hz: its readings stay for two rows or three, or for three
// or four, which have no common multiple.
TEST_CASE("readings: those that stay for unequal numbers of rows are held", "[signal]") {
  for (const double rate : {10.0, 7.0})
    for (const double unit : {0.0, 0.01})
      for (unsigned seed = 1; seed <= 10; ++seed) {
        const Series now = speeds(1, 0.1, unit, 0.1, seed);
        Series log;
        for (std::size_t i = 0; i < now.size(); ++i)
          log.push_back(now[static_cast<std::size_t>(static_cast<double>(i) * rate / 25)]);
        CAPTURE(rate, unit, seed);
        CHECK(are_held(log));
        CHECK(!are_held(now));
      }
}

// Whole km/h fall in steps of one, which may be a grid; that each of them stays for two rows is
// none.
TEST_CASE("readings: whole numbers that were held for two rows each", "[signal]") {
  for (const std::size_t held : {1U, 2U, 3U}) {
    Series v;
    for (std::size_t i = 0; i < 80; ++i) {
      const auto t = static_cast<double>(i - i % held);
      v.push_back(std::round(t < 10 ? 4 * t : 40 * std::exp(-0.016 * (t - 10))));
    }
    CAPTURE(held);
    CHECK(are_held(v) == (held > 1));
  }
}

TEST_CASE("readings: those that are merely rounded, at rest or few are not held", "[signal]") {
  for (const double unit : {0., 1e-5, 0.001, 0.01, 0.1})
    for (const double size : {0., 0.001, 0.01, 0.05, 0.2})
      for (const double slowing : {0., 1e-3, 0.05, 0.2})
        for (unsigned seed = 1; seed <= 20; ++seed) {
          INFO("unit " << unit << ", noise " << size << ", slowing " << slowing << ", seed "
                       << seed);
          CHECK(!are_held(speeds(1, size, unit, slowing, seed)));
        }
  // A roll that stops within the row, seen to 1 mm at 25 Hz: fast at first, at rest at the end.
  for (const double size : {0., 5e-5, 1e-4, 2e-4, 3e-4, 1e-3})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      INFO("noise " << size << ", seed " << seed);
      const Series e = noise(100, seed);
      Series x;
      for (std::size_t i = 0; i < e.size(); ++i) {
        const double left = std::max(0.0, 2 - 0.04 * static_cast<double>(i));
        x.push_back(std::round(1e3 * (0.5 - left * left / 4 + size * e[i])) / 1e3);
      }
      CHECK(!are_held(x));
    }
  Series stopped;  // speeds with a rest between two pushes
  for (int i = 0; i < 40; ++i) stopped.push_back(std::round(1e3 * (0.5 - 0.0111 * i)) / 1e3);
  stopped.insert(stopped.end(), 100, 0);
  for (int i = 0; i < 40; ++i) stopped.push_back(std::round(1e3 * (0.5 - 0.0117 * i)) / 1e3);
  CHECK(!are_held(stopped));
  CHECK(!are_held({}));
  CHECK(!are_held(Series{1}));
  CHECK(!are_held(Series{1, 1}));
  CHECK(!are_held(Series{0, 0, 0, 0, 0, 1, 0.7, 0.3, 0, 0, 0, 0}));
}

namespace {

/// A number as a spreadsheet writes it.
double written(double y, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, y);
  return std::strtod(text, nullptr);
}

/// Speeds of a roll from 0.5 m/s to rest: differences of positions that were rounded to a unit,
/// with noise of 0.3 mm; one position in `lost` is lost.
Series differences(double rate, double slowing, double unit, std::size_t lost, int digits,
                   unsigned seed) {
  const Series e = noise(static_cast<std::size_t>(0.5 / slowing * rate), seed);
  Series t, x, v;
  for (std::size_t i = 0; i < e.size(); ++i) {
    if (i % lost == lost / 2) continue;
    t.push_back(static_cast<double>(i) / rate);
    x.push_back(
        std::round((0.5 * t.back() - slowing * t.back() * t.back() / 2 + 3e-4 * e[i]) / unit) *
        unit);
  }
  for (std::size_t i = 1; i + 1 < t.size(); ++i)
    v.push_back(written((x[i + 1] - x[i - 1]) / (t[i + 1] - t[i - 1]), digits));
  return v;
}

}  // namespace

TEST_CASE("readings: differences of rounded positions are not held", "[signal]") {
  int all = 0, told = 0;
  for (const double rate : {20., 25., 30., 50., 100.})
    for (const double slowing : {0.085, 0.25})  // on felt, on rubber
      for (const double unit : {1e-3, 1.1e-3, 2e-3})
        for (const std::size_t lost : {20u, 50u, 1000u})
          for (const int digits : {4, 5, 17})
            for (unsigned seed = 1; seed <= 10; ++seed) {
              const bool held = are_held(differences(rate, slowing, unit, lost, digits, seed));
              INFO("rate " << rate << ", slowing " << slowing << ", unit " << unit << ", one in "
                           << lost << " lost, digits " << digits << ", seed " << seed);
              if (lost > 20) CHECK(!held);
              else ++all, told += held;  // many steps over two intervals are off the grid
            }
  INFO(told << " of " << all);
  CHECK(told <= 0.03 * all);
}

TEST_CASE("readings: held readings are told on a grid of some units a step", "[signal]") {
  for (const double unit : {0.004, 0.0125, 1. / 60})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      INFO("unit " << unit << ", seed " << seed);
      const Series now = speeds(1, 5 * unit, unit, 0.1, seed);
      Series twice;
      for (std::size_t i = 0; i < 1000; ++i) twice.push_back(written(now[i / 2], 5));
      CHECK(are_held(twice));
      CHECK(!are_held(now));
    }
}

namespace {

double rounded(double x, double place) { return std::round(x / place) * place; }

/// The pulses of a wheel that slows down evenly, every 5 cm.
std::vector<double> pulses() {
  std::vector<double> t;
  for (int n = 0; n < 15; ++n) t.push_back(rounded(3 * (1 - std::sqrt(1 - n / 16.)), 1e-5));
  return t;
}

}  // namespace

// n means of m rows tell as much as n/m readings: their noise is that of the sensor again.
TEST_CASE("readings: how many rows a mean is of, and the noise of means", "[signal]") {
  constexpr double size = 0.05;
  for (const std::size_t rows : {1u, 2u, 3u, 5u, 11u}) {
    int told = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const Series v = speeds(1, size, 1e-4, 0.1, seed);
      std::vector<Sample> means;
      for (std::size_t i = 0; i + rows <= v.size(); ++i) {
        double sum = 0;
        for (std::size_t k = i; k < i + rows; ++k) sum += v[k];
        means.push_back({0.04 * static_cast<double>(i), sum / static_cast<double>(rows)});
      }
      const auto [seen, noise] = means_of_rows(means);
      // Means of two rows are hardly other than differences over two.
      const std::size_t right = rows == 2 ? 1 : rows;
      told += seen == right || (rows == 11 && seen + 1 >= right && seen <= right + 1);
      if (seen > 1) CHECK((noise > 0.75 * size && noise < 1.33 * size));
    }
    CAPTURE(rows, told);
    CHECK(told >= 19);
  }
}

// Those of PASCO's programs were once taken for means of three rows, and the rolls of
// samples/CR.csv ended 0.28 s early by its speeds.
TEST_CASE("readings: speeds by a sensor's differences, few and equal readings are no means",
          "[signal]") {
  for (const char* sensor : {"central", "pasco", "vernier"})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const auto differences = make_signal(*signal_options(derivative_methods, sensor));
      const Series x = speeds(1, 0.001, 0, 0.1, seed);
      std::vector<Sample> v;
      const auto take = [&](std::span<const double> values) {
        for (const double y : values) v.push_back({0.04 * static_cast<double>(v.size()), y});
      };
      for (std::size_t i = 0; i < x.size(); ++i)
        take(differences->push(0.04 * static_cast<double>(i), x[i]));
      take(differences->finish());
      CAPTURE(sensor, seed);
      CHECK(means_of_rows(v).rows == 1);
    }
  CHECK(means_of_rows({}).rows == 1);
  CHECK(means_of_rows(std::vector<Sample>{{0, 1}, {1, 2}, {2, 1}, {3, 4}}).rows == 1);
  std::vector<Sample> rest;
  for (int i = 0; i < 100; ++i) rest.push_back({0.04 * i, 1});
  CHECK(means_of_rows(rest).rows == 1);
}

TEST_CASE("readings: pulses, one way over the time from row to row, stamped at either end") {
  const std::vector<double> t = pulses();
  for (const double way : {0.05, -0.05}) {
    std::vector<double> after(t.size(), 0.27), before = after;
    for (std::size_t i = 1; i < t.size(); ++i)
      after[i] = before[i - 1] = rounded(way / (t[i] - t[i - 1]), 1e-6);
    CHECK(way_between_pulses(t, after).value() == Approx(way).epsilon(1e-3));
    CHECK(way_between_pulses(t, before).value() == Approx(way).epsilon(1e-3));
    after[7] *= 1.01;
    CHECK_FALSE(way_between_pulses(t, after));
  }
}

TEST_CASE(
    "readings: pulses, whatever the last place of the times and of the speeds, and the clock's "
    "zero") {
  for (const double begin : {0., 100., 1.7e9, -1.7e9})
    for (int places_of_t = 4; places_of_t <= 12; ++places_of_t)
      for (int places_of_v = 3; places_of_v <= 12; ++places_of_v) {
        CAPTURE(begin, places_of_t, places_of_v);
        std::vector<double> t, v{0};
        for (int n = 0; n < 60; ++n)
          t.push_back(begin +
                      rounded(20 * (1 - std::sqrt(1 - n / 64.)), std::pow(10, -places_of_t)));
        for (std::size_t i = 1; i < t.size(); ++i)
          v.push_back(rounded(0.05 / (t[i] - t[i - 1]), std::pow(10, -places_of_v)));
        CHECK(way_between_pulses(t, v).value() == Approx(0.05).epsilon(0.01));
      }
}

TEST_CASE("readings: speeds that are measured otherwise are none") {
  const std::vector<double> t = pulses();
  std::vector<double> v, even, constant(t.size(), 0.2);
  for (std::size_t i = 0; i < t.size(); ++i) {
    v.push_back(0.5 - 0.1 * t[i]);
    even.push_back(0.1 * static_cast<double>(i));
  }
  CHECK_FALSE(way_between_pulses(t, v));
  CHECK_FALSE(way_between_pulses(even, constant));  // even times tell nothing
  CHECK_FALSE(way_between_pulses(t, std::vector<double>(t.size(), NAN)));
}

// The pulses of the whole run and of its end are seen; the times of fewer, and of nearly even ones,
// would fit by chance.
TEST_CASE("readings: it takes five pulses, and times that differ by 1.3") {
  const auto speeds_of = [](const std::vector<double>& t) {
    std::vector<double> v{0};
    for (std::size_t i = 1; i < t.size(); ++i) v.push_back(0.05 / (t[i] - t[i - 1]));
    return v;
  };
  const auto all = pulses();
  const std::vector<double> five(all.end() - 5, all.end());
  const std::vector<double> four(all.end() - 4, all.end());
  CHECK(way_between_pulses(five, speeds_of(five)));
  CHECK_FALSE(way_between_pulses(four, speeds_of(four)));
  for (const double factor : {1.29, 1.31}) {
    const std::vector<double> t{0, 0.1, 0.2, 0.3, 0.4, 0.4 + 0.1 * factor};
    CHECK(way_between_pulses(t, speeds_of(t)).has_value() == (factor > 1.3));
  }
}

TEST_CASE("readings: those that jump off the motion are counted, and told from a push",
          "[signal]") {
  for (const double slowing : {0.05, 0.2}) {
    const Series v = speeds(1, 0.02, 0, slowing, 1);
    std::vector<Sample> run;
    for (const double y : v) run.push_back({0.04 * static_cast<double>(run.size()), y});
    for (std::size_t i = 0; i < 25; ++i) run[i].y = 0.02;  // at rest, and fast in the next row
    CHECK(spikes_in(run).found == 0);
    for (std::size_t i = 32; i < run.size(); i += 8) run[i].y = 9;
    const Spikes spikes = spikes_in(run);
    CHECK(spikes.found == 58);  // and one among the last five rows
    CHECK(spikes.first.t == 0.04 * 32);
    CHECK(spikes.first.y == 9);
  }
  CHECK(spikes_in({}).found == 0);
}

TEST_CASE("readings: the noise of a body at rest is no spike", "[signal]") {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.3, 4e-4);
  std::size_t with_spikes = 0;
  for (int run = 0; run < 200; ++run) {
    std::vector<Sample> rest;
    for (int i = 0; i < 100; ++i) rest.push_back({0.04 * i, noise(random)});
    with_spikes += spikes_in(rest).found > 0;
  }
  CHECK(with_spikes <= 2);
}

TEST_CASE("readings: a counter that starts over is told from a step and from spikes", "[signal]") {
  std::vector<Sample> run;
  for (int i = 0; i < 100; ++i) run.push_back({0.04 * i, std::fmod(64000 + 40.0 * i, 65536)});
  CHECK(start_over(run) == 39);
  for (Sample& s : run) s.y = 65535 - s.y;
  CHECK(start_over(run) == 39);
  for (Sample& s : run) s.y = s.t;
  CHECK(!start_over(run));
  run[50].y = 100;
  CHECK(!start_over(run));
  for (std::size_t i = 51; i < 54; ++i) run[i].y = 100 - run[i].y;  // a burst
  CHECK(!start_over(run));
  for (std::size_t i = 50; i < run.size(); ++i) run[i].y = 100;
  CHECK(!start_over(run));
  CHECK(!start_over(std::span<const Sample>(run).first(2)));
}

TEST_CASE("readings: a counter goes back over nine tenths of its range", "[signal]") {
  for (const int back : {53, 54}) {
    std::vector<Sample> run;
    for (int i = 0; i < 100; ++i) run.push_back({0.04 * i, i < 60. ? i : i - 1. - back});
    CHECK(start_over(run).has_value() == (back > 0.9 * 59));
  }
}

TEST_CASE(
    "readings: the way of the positions beside that of the speeds, whatever few readings say") {
  std::vector<double> t, x, v;
  for (int i = 0; i < 60; ++i) {
    t.push_back(0.05 * i);
    v.push_back(0.5 - 0.25 * t.back());  // it turns at 2 s
    x.push_back(0.3 + 0.5 * t.back() - 0.125 * t.back() * t.back());
  }
  CHECK(ways_ratio(t, x, v) == Approx(1).epsilon(1e-12));
  for (double& speed : v) speed *= -1 / 3.6;
  CHECK(ways_ratio(t, x, v) == Approx(3.6).epsilon(1e-12));
  x[20] = 0;
  v[33] = NAN;
  x[47] = 9;
  CHECK(ways_ratio(t, x, v) == Approx(3.6).epsilon(1e-2));
  CHECK(std::isnan(ways_ratio(std::span(t).first(9), x, v)));
  const std::vector<double> rest(60, 0);  // no way beside none
  CHECK(std::isnan(ways_ratio(t, rest, rest)));
  for (std::size_t i = 12; i < 60; ++i) {  // two stretches of three are at rest
    x[i] = x[11];
    v[i] = 0;
  }
  CHECK(ways_ratio(t, x, v) == Approx(3.6).epsilon(0.1));
  CHECK(std::isfinite(ways_ratio(std::span(t).first(10), x, v)));
}

// Rounding matters from a twentieth of a step on, unless the steps are whole numbers of the place.
TEST_CASE("readings: times are rounded where a step is no whole number of their place") {
  for (const double rate : {10.0, 24.0, 25.0, 30.0, 50.0, 60.0, 120.0})
    for (const double place : {0.02, 0.01, 0.001, 0.0001})
      for (const int lost : {1000, 4}) {
        std::vector<double> t;
        for (int i = 0; i < 200; ++i)
          if (i % lost != 1) t.push_back(place * std::round(i / rate / place));
        const double steps = 1 / rate / place;  // in a step
        const bool is_whole = std::abs(steps - std::round(steps)) < 0.1;
        CAPTURE(rate, place, lost);
        if (steps < 2) continue;  // a step of the place itself: lost rows look the same
        const auto rounded = rounded_times(t);
        CHECK(rounded.has_value() == (!is_whole && steps < 20));
        if (!rounded) continue;
        CHECK(rounded->place == Approx(place).epsilon(1e-6));
        CHECK(rounded->step == Approx(1 / rate).epsilon(0.02));
      }
  CHECK_FALSE(rounded_times({}).has_value());
}
