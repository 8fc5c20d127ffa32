#include "signal/hampel.h"

#include <cmath>

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

TEST_CASE("hampel: straight lines and constants have none", "[signal]") {
  Series line;
  for (int i = 0; i < 60; ++i) line.push_back(0.1 * i);
  CHECK(outliers(line, {11, 0}, 2).empty());
  CHECK(outliers(Series(60, 7)).empty());
  CHECK(outliers({5}).empty());
  CHECK(outliers({}).empty());
}
