#include "signal/hampel.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "unit/catch.h"
#include "unit/signal/through.h"

using namespace rolling;

namespace {

/// Indices of the outliers.
std::vector<std::size_t> outliers(const Series& y, Width width, double threshold, const Series& t) {
  Hampel hampel(width, threshold);
  std::vector<std::size_t> out;
  std::size_t i = 0;
  const auto take = [&](std::span<const Judged> samples) {
    for (const Judged& s : samples) {
      CHECK((s.t == t[i] && s.y == y[i]));
      if (!s.kept) out.push_back(i);
      ++i;
    }
  };
  for (std::size_t j = 0; j < y.size(); ++j) take(hampel.push(t[j], y[j]));
  take(hampel.finish());
  CHECK(i == y.size());
  return out;
}

std::vector<std::size_t> outliers(const Series& y, Width width = {11, 0}, double threshold = 3) {
  return outliers(y, width, threshold, even_times(y.size()));
}

using Indices = std::vector<std::size_t>;

}  // namespace

TEST_CASE("hampel: spikes on a noisy slope are found, first and last record too", "[signal]") {
  Series y = noise(100, 3);
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] = 0.001 * y[i] + 0.5 - 0.002 * static_cast<double>(i);
  const Indices spikes = {0, 17, 50, 51, 99};
  for (const std::size_t i : spikes) y[i] += 0.1;
  CHECK(outliers(y, {11, 0}, 6) == spikes);
  CHECK(outliers(y, {0, 0.4}, 6) == spikes);
}

TEST_CASE("hampel: normal noise passes as often as it should", "[signal]") {
  const std::size_t n = 20000;
  const auto count = outliers(noise(n, 4), {101, 0}, 3).size();  // 0.27 % of a normal distribution
  CHECK(count > 35);
  CHECK(count < 85);
}

TEST_CASE("hampel: the threshold, by hand", "[signal]") {
  // median 3, distances 2 1 0 1 y - 3, their median 1
  CHECK(outliers({1, 2, 3, 4, 3 + 1.4826 * 3 - 1e-9}, {9, 0}, 3).empty());
  CHECK(outliers({1, 2, 3, 4, 3 + 1.4826 * 3 + 1e-9}, {9, 0}, 3) == Indices{4});
}

TEST_CASE("hampel: the last digit of rounded readings at rest makes no outlier", "[signal]") {
  Series y(50, 0.3);
  y[20] = 0.301, y[30] = 0.299;
  CHECK(outliers(y).empty());
  y[40] = 0.35;
  CHECK(outliers(y) == Indices{40});
}

TEST_CASE("hampel: nor does it in what a program computed from them", "[signal]") {
  // Central differences of positions, rounded to 1 mm, at 25 Hz: of a body that moves 1 mm from
  // record to record, 0.025 with rounding errors; at rest behind it -0.0125, 0 or 0.0125.
  Series x;
  for (const double flicker : noise(400, 8))
    x.push_back(0.001 * std::min(100.0, static_cast<double>(x.size())) +
                std::round(flicker * 0.35) / 1000);
  Series speeds, digits;
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    speeds.push_back((x[i + 1] - x[i - 1]) / 0.08);
    digits.push_back(std::round(speeds.back() * 1e6) / 1e6);
  }
  speeds[250] = digits[250] = 0.1;
  CHECK(outliers(digits, {11, 0}, 4) == Indices{250});
  CHECK(outliers(speeds, {11, 0}, 4) == Indices{250});
}

TEST_CASE("hampel: as sorting each window has it, wide ones and ties too", "[signal]") {
  // By definition: the window's median and median distance from it, by sorting.
  const auto middle = [](Series values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 ? values[n / 2] : std::midpoint(values[n / 2 - 1], values[n / 2]);
  };
  for (const std::size_t half : {5u, 20u, 400u, 1500u}) {
    const std::size_t n = 3 * half + 7;
    Series y = noise(n, static_cast<unsigned>(half));
    for (double& value : y) value = std::round(value * 40) / 40;  // ties
    Indices expected;
    for (std::size_t i = 0; i < n; ++i) {
      const Series window(y.begin() + static_cast<std::ptrdiff_t>(i - std::min(i, half)),
                          y.begin() + static_cast<std::ptrdiff_t>(std::min(i + half + 1, n)));
      const double centre = middle(window);
      Series distances;
      for (const double value : window) distances.push_back(std::abs(value - centre));
      const double scale = 1.4826 * middle(distances);
      if (std::abs(y[i] - centre) > 2.5 * scale) expected.push_back(i);
    }
    CHECK(outliers(y, {2 * half + 1, 0}, 2.5) == expected);
    CHECK((half == 5 || !expected.empty()));
  }
}

TEST_CASE("hampel: no window has less than 11 samples", "[signal]") {
  Series y = noise(2000, 5);
  y[700] = 30;
  const Indices by_11 = outliers(y, {11, 0}, 4);
  CHECK(by_11.size() < 30);
  CHECK(std::count(by_11.begin(), by_11.end(), 700) == 1);
  for (const Width width : {Width{1, 0}, {3, 0}, {5, 0}, {0, 1e-6}, {0, 0.1}})
    CHECK(outliers(y, width, 4) == by_11);
  for (std::size_t n = 1; n < 14; ++n)
    CHECK(outliers(noise(n, 3), {0, 0.04}, 4) == outliers(noise(n, 3), {11, 0}, 4));
}

TEST_CASE("hampel: straight lines and constants have none", "[signal]") {
  Series line;
  for (int i = 0; i < 60; ++i) line.push_back(0.1 * i);
  CHECK(outliers(line, {11, 0}, 2).empty());
  CHECK(outliers(Series(60, 7)).empty());
  CHECK(outliers({5}).empty());
  CHECK(outliers({}).empty());
}
