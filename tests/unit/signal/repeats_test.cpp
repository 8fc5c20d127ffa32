// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/repeats.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

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

TEST_CASE("repeats: readings that were held are told, with how long", "[signal]") {
  for (const std::size_t held : {2u, 5u, 25u})
    for (const double unit : {0., 0.001, 0.01})
      for (const double size : {0.001, 0.05})
        for (unsigned seed = 1; seed <= 20; ++seed) {
          if (size < 3 * unit && 0.01 * static_cast<double>(held) < 3 * unit) continue;
          INFO(held << " rows, unit " << unit << ", noise " << size << ", seed " << seed);
          const double found = rows_held(speeds(held, size, unit, 0.1, seed));
          CHECK(std::abs(found / static_cast<double>(held) - 1) < 0.2);
        }
}

TEST_CASE("repeats: readings that are merely rounded, at rest or few are not held", "[signal]") {
  for (const double unit : {0., 1e-5, 0.001, 0.01, 0.1})
    for (const double size : {0., 0.001, 0.01, 0.05, 0.2})
      for (const double slowing : {0., 1e-3, 0.05, 0.2})
        for (unsigned seed = 1; seed <= 20; ++seed) {
          INFO("unit " << unit << ", noise " << size << ", slowing " << slowing << ", seed "
                       << seed);
          CHECK(rows_held(speeds(1, size, unit, slowing, seed)) == 1);
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
      CHECK(rows_held(x) == 1);
    }
  Series stopped;  // speeds with a rest between two pushes
  for (int i = 0; i < 40; ++i) stopped.push_back(std::round(1e3 * (0.5 - 0.0111 * i)) / 1e3);
  stopped.insert(stopped.end(), 100, 0);
  for (int i = 0; i < 40; ++i) stopped.push_back(std::round(1e3 * (0.5 - 0.0117 * i)) / 1e3);
  CHECK(rows_held(stopped) == 1);
  CHECK(rows_held({}) == 1);
  CHECK(rows_held(Series{1}) == 1);
  CHECK(rows_held(Series{1, 1}) == 1);
  CHECK(rows_held(Series{0, 0, 0, 0, 0, 1, 0.7, 0.3, 0, 0, 0, 0}) == 1);
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

TEST_CASE("repeats: differences of rounded positions are not held", "[signal]") {
  for (const double rate : {20., 25., 30., 50., 100.})
    for (const double slowing : {0.085, 0.25})  // on felt, on rubber
      for (const double unit : {1e-3, 1.1e-3, 2e-3})
        for (const std::size_t lost : {20u, 50u, 1000u})
          for (const int digits : {4, 5, 17})
            for (unsigned seed = 1; seed <= 10; ++seed) {
              INFO("rate " << rate << ", slowing " << slowing << ", unit " << unit << ", one in "
                           << lost << " lost, digits " << digits << ", seed " << seed);
              CHECK(rows_held(differences(rate, slowing, unit, lost, digits, seed)) == 1);
            }
}

TEST_CASE("repeats: held readings are told on a grid of some units a step", "[signal]") {
  for (const double unit : {0.004, 0.0125, 1. / 60})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      INFO("unit " << unit << ", seed " << seed);
      const Series now = speeds(1, 5 * unit, unit, 0.1, seed);
      Series twice;
      for (std::size_t i = 0; i < 1000; ++i) twice.push_back(written(now[i / 2], 5));
      CHECK(std::abs(rows_held(twice) - 2) < 0.4);
      CHECK(rows_held(now) == 1);
    }
}
