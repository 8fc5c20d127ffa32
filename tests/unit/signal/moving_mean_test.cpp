// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/moving.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"
#include "unit/signal/exact.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

using Series = std::vector<double>;

Series even_times(std::size_t n) {
  Series t;
  for (std::size_t i = 0; i < n; ++i) t.push_back(0.04 * static_cast<double>(i));
  return t;
}

Series smoothed(const Series& t, const Series& y, Width window) {
  const auto mean = moving_mean(window);
  Series out;
  for (std::size_t i = 0; i < t.size(); ++i)
    for (const double value : mean->push(t[i], y[i])) out.push_back(value);
  for (const double value : mean->finish()) out.push_back(value);
  return out;
}

Series smoothed(const Series& y, std::size_t width) {
  return smoothed(even_times(y.size()), y, {width, 0});
}

/// Half the width of the window of samples about i, by definition.
std::size_t half_width(std::size_t i, std::size_t n, std::size_t width) {
  return std::min({width / 2, i, n - 1 - i});
}

std::size_t half_width(std::size_t i, const Series& t, double seconds) {
  std::size_t k = 0;
  const auto near = [&](std::size_t j) {
    const double step = std::abs(t[j] - t[j < i ? j + 1 : j - 1]);
    return std::abs(t[j] - t[i]) - step / 16 <= seconds / 2;
  };
  while (k < i && i + k + 1 < t.size() && near(i - k - 1) && near(i + k + 1)) ++k;
  return k;
}

Series reversed(Series values) {
  std::reverse(values.begin(), values.end());
  return values;
}

}  // namespace

TEST_CASE("moving_mean: by hand", "[signal]") {
  CHECK(smoothed({1, 5, 3}, 3) == Series{1, 3, 3});
  CHECK(smoothed({1, 2, 6, 7, 4}, 5) == Series{1, 3, 4, 17. / 3, 4});
  CHECK(smoothed({7}, 11) == Series{7});
  CHECK(smoothed(Series{}, 11).empty());
  CHECK(smoothed({3, 1, 4, 1, 5}, 1) == Series{3, 1, 4, 1, 5});
}

TEST_CASE("moving_mean: a straight line comes out as itself, to its ends", "[signal]") {
  Series line;
  for (int i = 0; i < 200; ++i) line.push_back(3 - 0.25 * i);  // exact in binary
  for (const std::size_t width : {1u, 3u, 11u, 51u, 199u, 201u, 999u})
    CHECK(smoothed(line, width) == line);
  CHECK(smoothed(even_times(200), line, {0, 0.4}) == line);
}

TEST_CASE("moving_mean: a constant that is not a binary fraction comes out as itself", "[signal]") {
  const Series constant(500, 0.1);
  for (const std::size_t width : {3u, 11u, 101u}) CHECK(smoothed(constant, width) == constant);
}

TEST_CASE("moving_mean: each mean is within 1 ulp of its window's, next to an outlier and after it",
          "[signal]") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> speed(-0.5, 0.5);
  Series y;
  for (int i = 0; i < 400; ++i) y.push_back(speed(random));
  y[100] = -9e33;
  y[200] = 9e33, y[203] = -9e33;
  for (const std::size_t width : {3u, 11u, 51u}) {
    const Series means = smoothed(y, width);
    REQUIRE(means.size() == y.size());
    int failures = 0;
    for (std::size_t i = 0; i < y.size(); ++i) {
      const std::size_t k = half_width(i, y.size(), width);
      failures += !within_one_ulp(std::span(y).subspan(i - k, 2 * k + 1), means[i]);
    }
    CHECK(failures == 0);
  }
  y[100] = 0.25;
  Series calm = y;
  calm[100] = 0.3;
  const Series with = smoothed(y, 11), without = smoothed(calm, 11);
  CHECK(with[120] == without[120]);  // an outlier leaves no trace
}

TEST_CASE("moving_mean: the greatest and the least doubles", "[signal]") {
  CHECK(smoothed({1e308, 1e308, 1e308}, 3) == Series{1e308, 1e308, 1e308});
  const double tiny = std::numeric_limits<double>::denorm_min();
  CHECK(smoothed({tiny, 4 * tiny, tiny, 0, -tiny}, 3) ==
        Series{tiny, 2 * tiny, 2 * tiny, 0, -tiny});
  std::mt19937_64 random(2);
  Series y;
  for (int i = 0; i < 100; ++i) y.push_back(tiny * static_cast<double>(random() % 1000));
  const Series means = smoothed(y, 7);
  for (std::size_t i = 0; i < y.size(); ++i) {
    const std::size_t k = half_width(i, y.size(), 7);
    CHECK(within_one_ulp(std::span(y).subspan(i - k, 2 * k + 1), means[i], std::ldexp(1, 300)));
  }
}

TEST_CASE("moving_mean: it commutes with reversing time", "[signal]") {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> speed(-0.5, 0.5), step(0.01, 0.09);
  Series t, y;
  for (int i = 0; i < 300; ++i) {
    t.push_back((t.empty() ? 0 : t.back()) +
                std::round(1024 * step(random)) / 1024);  // exact, so that -t is as far apart
    y.push_back(speed(random));
  }
  Series back;
  for (const double time : reversed(t)) back.push_back(-time);
  for (const Width window : {Width{11, 0}, {51, 0}, {0, 0.3}, {0, 2}})
    CHECK(smoothed(back, reversed(y), window) == reversed(smoothed(t, y, window)));
}

TEST_CASE("moving_mean: a window of seconds takes as many samples as lie within it on both sides",
          "[signal]") {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> speed(-0.5, 0.5), step(0.001, 0.2);
  Series t, y;
  for (int i = 0; i < 500; ++i) {
    t.push_back((t.empty() ? -3 : t.back()) + (i % 50 == 0 ? 2 : step(random)));  // with gaps
    y.push_back(speed(random));
  }
  for (const double seconds : {1e-6, 0.05, 0.4, 3.0, 1e6}) {
    const Series means = smoothed(t, y, {0, seconds});
    REQUIRE(means.size() == y.size());
    int failures = 0;
    for (std::size_t i = 0; i < y.size(); ++i) {
      const std::size_t k = half_width(i, t, seconds);
      failures += !within_one_ulp(std::span(y).subspan(i - k, 2 * k + 1), means[i]);
    }
    INFO(seconds);
    CHECK(failures == 0);
  }
}

TEST_CASE("moving_mean: rounding of the times does not decide a window of seconds", "[signal]") {
  Series y;
  for (int i = 0; i < 100; ++i) y.push_back(i % 7);
  CHECK(smoothed(even_times(100), y, {0, 0.08}) ==
        smoothed(y, 3));  // 0.04 i: some steps are a hair more than 0.04
  CHECK(smoothed(even_times(100), y, {0, 0.4}) == smoothed(y, 11));
}

TEST_CASE("moving_mean: a mean is known as soon as its window is", "[signal]") {
  const auto mean = moving_mean({5, 0});
  CHECK(mean->push(0, 1).size() == 1);  // the first is its own window
  CHECK(mean->push(1, 1).empty());
  CHECK(mean->push(2, 1).size() == 1);
  CHECK(mean->push(3, 1).empty());
  for (int i = 4; i < 50; ++i) CHECK(mean->push(i, 1).size() == 1);
  CHECK(mean->finish().size() == 2);
  const auto seconds = moving_mean({0, 2});
  CHECK(seconds->push(0, 1).size() == 1);
  CHECK(seconds->push(1, 1).empty());
  CHECK(seconds->push(1.5, 1).size() ==
        1);  // one on each side of 1 s: more to come on the right could not be matched on the left
  CHECK(seconds->push(2, 1).size() == 1);
  CHECK(seconds->push(9, 1).size() == 2);  // nothing within a second of it
  CHECK(seconds->finish().empty());
}

TEST_CASE("moving_mean: an even width is refused", "[signal]") {
  CHECK_THROWS_AS(moving_mean({10, 0}), Error);
  CHECK_THROWS_AS(moving_mean({0, 0}), Error);
}

namespace {

/// The largest distance, in ulps, of a mean over 11 of `rows` samples from the exact mean of its
/// window. The samples come in stretches, each harder on a running sum than the last: speeds, an
/// outlier of -9e33, 1e308 three times, denormal numbers, 0.1.
double largest_error_in_ulps(std::size_t rows) {
  constexpr std::size_t half = 5, width = 2 * half + 1, stretch = 1000;
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> speed(-0.5, 0.5);
  const auto sample = [&](std::size_t i) {
    const std::size_t at = i % stretch;
    switch (i / stretch % 5) {
      case 0:
        return speed(random);
      case 1:
        return at == 500 ? -9e33 : speed(random);
      case 2:
        return at >= 500 && at < 503 ? 1e308 : speed(random);
      case 3:
        return std::ldexp(static_cast<double>(random() % 100000), -1074);
      default:
        return 0.1;
    }
  };
  const auto mean = moving_mean({width, 0});
  std::vector<double> y;  // the last `width`
  double largest = 0;
  std::size_t known = 0;
  const auto judge = [&](double value) {
    if (known++ < half) return;
    double most = 0;
    for (const double v : y) most = std::max(most, std::abs(v));
    const double scale = most > 1e300 ? std::ldexp(1, -20) : most < 1e-300 ? std::ldexp(1, 300) : 1;
    FixedPoint off;
    for (const double v : y) off.add(scale * v);
    off.add_product(-static_cast<double>(width), scale * value);
    const double ulp =
        scale * (std::nextafter(std::abs(value), std::numeric_limits<double>::infinity()) -
                 std::abs(value));
    largest = std::max(largest, std::abs(off.nearly()) / (static_cast<double>(width) * ulp));
  };
  for (std::size_t i = 0; i < rows; ++i) {
    if (y.size() == width) y.erase(y.begin());
    y.push_back(sample(i));
    for (const double value : mean->push(static_cast<double>(i), y.back())) judge(value);
  }
  return known + half == rows ? largest : std::numeric_limits<double>::infinity();
}

}  // namespace

TEST_CASE("moving_mean: within 1 ulp over a million rows, whatever they are", "[signal]") {
  const double ulps = largest_error_in_ulps(1'000'000);
  CAPTURE(ulps);
  CHECK(ulps <= 1);
  CHECK(ulps > 0.4);  // the measure sees rounding
}

TEST_CASE("moving_mean: within 1 ulp over ten million rows", "[.long]") {
  const double ulps = largest_error_in_ulps(10'000'000);
  WARN("largest error: " << ulps << " ulp");
  CHECK(ulps <= 1);
}
