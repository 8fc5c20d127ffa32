// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/outliers.h"

#include <algorithm>
#include <cmath>

#include "unit/catch.h"
#include "unit/signal/through.h"

using namespace rolling;

namespace {

using Indices = std::vector<std::size_t>;

Indices outliers(const Series& y, const Series& t, double threshold = 5, Width width = {11, 0}) {
  Outliers test(width, threshold);
  Indices out;
  std::size_t i = 0;
  const auto take = [&](std::span<const Sample> samples) {
    for (const Sample& s : samples) {
      CHECK((s.t == t[i] && (std::isnan(s.y) || s.y == y[i])));
      if (std::isnan(s.y)) out.push_back(i);
      ++i;
    }
  };
  for (std::size_t j = 0; j < y.size(); ++j) take(test.push(t[j], y[j]));
  take(test.finish());
  CHECK(i == y.size());
  return out;
}
Indices outliers(const Series& y, double threshold = 5) {
  return outliers(y, even_times(y.size()), threshold);
}

constexpr double sigma = 3e-4;

/// Positions of a body that rests, is pushed within 0.3 s, rolls and stops, and rests; from 0.3 m.
Series roll(std::size_t n, unsigned seed, double release = 1.3) {
  Series x = noise(n, seed);
  for (std::size_t i = 0; i < n; ++i) {
    const double s = 0.04 * static_cast<double>(i) - release, v0 = 0.45, a = 0.1;
    const double pushed = std::clamp(s / 0.3 + 1, 0.0, 1.0), rolled = std::clamp(s, 0.0, v0 / a);
    x[i] = 0.3 + sigma * x[i] + v0 * 0.15 * pushed * pushed + v0 * rolled - a / 2 * rolled * rolled;
  }
  return x;
}

}  // namespace

TEST_CASE("outliers: zeros, spikes of ten sigma and bursts of three, on a moving body too",
          "[signal]") {
  // after the push of a whole record; and in a roll from its first row on, where each step is long,
  // to the last row at rest, anywhere
  for (const std::ptrdiff_t begin : {0, 35})
    for (const std::size_t many : {0U, 1U, 2U, 3U}) {  // 0: a zero; a burst
      std::size_t found = 0, wrong = 0, made = 0, good = 0;
      for (unsigned seed = 1; seed <= 800; ++seed) {
        Series x = roll(190, seed);
        const std::size_t rows = std::max<std::size_t>(many, 1);
        const std::size_t at = begin > 0 ? 35 + seed * 37 % (156 - rows) : 40 + seed * 37 % 140;
        Indices bad;
        for (std::size_t i = at; i < at + rows; ++i) {
          x[i] = many == 0 ? 0 : x[i] + 10 * sigma * (seed % 2 == 0 ? 1 : -1);
          bad.push_back(i - static_cast<std::size_t>(begin));
        }
        x.erase(x.begin(), x.begin() + begin);
        const Indices out = outliers(x);
        for (const std::size_t i : out) ++(std::count(bad.begin(), bad.end(), i) ? found : wrong);
        made += bad.size(), good += x.size() - bad.size();
      }
      INFO(many << ": found " << found << " of " << made << ", taken " << wrong << " of " << good);
      CHECK(100 * found >= 99 * made);
      CHECK(1000 * wrong <= good);
    }
}

TEST_CASE("outliers: normal noise passes as often as it should", "[signal]") {
  const std::size_t n = 20000;
  const auto count = outliers(noise(n, 4), 3).size();  // 0.27 % of a normal distribution
  CHECK(count > 20);
  CHECK(count < 140);
  CHECK(outliers(noise(n, 5), 5).size() <= 2);
}

TEST_CASE("outliers: a push, a stop and a wall are none", "[signal]") {
  std::size_t taken = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    Series x = noise(100, seed);
    for (std::size_t i = 0; i < 100; ++i) {
      const double t = 0.04 * static_cast<double>(i);
      x[i] = sigma * x[i] + (t < 2 ? 0.5 * t : 1 - 0.15 * (t - 2));
    }
    taken += outliers(x).size();
  }
  CHECK(taken <= 60);  // one in 300 rows, those next to the wall
}

TEST_CASE("outliers: the last digit of rounded readings at rest makes no outlier", "[signal]") {
  Series y(50, 0.3);
  y[20] = 0.301, y[30] = 0.299;
  CHECK(outliers(y, 4).empty());
  y[40] = 0.35;
  CHECK(outliers(y, 4) == Indices{40});
}

TEST_CASE("outliers: nor does it in what a program computed from them", "[signal]") {
  // Central differences of positions, rounded to 1 mm, at 25 Hz: of a body that moves 1 mm from
  // row to row, 0.025 with rounding errors; at rest behind it -0.0125, 0 or 0.0125.
  Series x;
  for (const double flicker : noise(400, 8))
    x.push_back(0.001 * std::min(100.0, static_cast<double>(x.size())) +
                std::round(flicker * 0.35) / 1000);
  Series speeds;
  for (std::size_t i = 1; i + 1 < x.size(); ++i) speeds.push_back((x[i + 1] - x[i - 1]) / 0.08);
  speeds[250] = 0.1;
  CHECK(outliers(speeds, 6) == Indices{250});
}

TEST_CASE("outliers: shifted, mirrored and scaled readings have the same ones", "[signal]") {
  Series x = roll(190, 9);
  x[60] += 0.01, x[61] += 0.01, x[120] = 0;
  const Indices expected = outliers(x);
  CHECK(expected == Indices{60, 61, 120});
  const auto of = [&](auto change) {
    Series y = x;
    for (double& value : y) value = change(value);
    return outliers(y);
  };
  CHECK(of([](double y) { return -y; }) == expected);
  CHECK(of([](double y) { return 1000 * y; }) == expected);
  CHECK(of([](double y) { return std::ldexp(y, 700); }) == expected);
  CHECK(of([](double y) { return std::ldexp(y, -700); }) == expected);
  CHECK(of([](double y) { return y + 8; }) == expected);
  Series t = even_times(x.size());
  for (double& time : t) time = std::ldexp(time, 300);
  CHECK(outliers(x, t) == expected);
}

TEST_CASE("outliers: with few samples none is decided by too few neighbours", "[signal]") {
  CHECK(outliers({1}).empty());
  CHECK(outliers({1, 2}).empty());
  CHECK(outliers({1, 2, 9}).empty());
  CHECK(outliers({1, 2, 3, 4, 5, 60, 7, 8, 9, 10}) == Indices{5});
}
