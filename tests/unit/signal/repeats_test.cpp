#include "signal/repeats.h"

#include <cmath>

#include "unit/catch.h"
#include "unit/signal/through.h"

using namespace rolling;

namespace {

/// Speeds of a body that slows down by a share of its speed a second, at 25 Hz, with normal noise,
/// rounded to a unit, each held for so many records.
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
          INFO(held << " records, unit " << unit << ", noise " << size << ", seed " << seed);
          const double found = records_held(speeds(held, size, unit, 0.1, seed));
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
          CHECK(records_held(speeds(1, size, unit, slowing, seed)) == 1);
        }
  // A roll that stops within the record, seen to 1 mm at 25 Hz: fast at first, at rest at the end.
  for (const double size : {0., 5e-5, 1e-4, 2e-4, 3e-4, 1e-3})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      INFO("noise " << size << ", seed " << seed);
      const Series e = noise(100, seed);
      Series x;
      for (std::size_t i = 0; i < e.size(); ++i) {
        const double left = std::max(0.0, 2 - 0.04 * static_cast<double>(i));
        x.push_back(std::round(1e3 * (0.5 - left * left / 4 + size * e[i])) / 1e3);
      }
      CHECK(records_held(x) == 1);
    }
  Series stopped;  // speeds with a rest between two pushes
  for (int i = 0; i < 40; ++i) stopped.push_back(std::round(1e3 * (0.5 - 0.0111 * i)) / 1e3);
  stopped.insert(stopped.end(), 100, 0);
  for (int i = 0; i < 40; ++i) stopped.push_back(std::round(1e3 * (0.5 - 0.0117 * i)) / 1e3);
  CHECK(records_held(stopped) == 1);
  CHECK(records_held({}) == 1);
  CHECK(records_held(Series{1}) == 1);
  CHECK(records_held(Series{1, 1}) == 1);
  CHECK(records_held(Series{0, 0, 0, 0, 0, 1, 0.7, 0.3, 0, 0, 0, 0}) == 1);
}
