// The short form of `make coverage`: the errors that fitpower prints hold.
#include "bench/coverage.h"
#include "unit/catch.h"

namespace {

coverage::Case find(const std::string& name, rolling::Route route) {
  for (const auto& c : coverage::cases())
    if (c.name == name && c.route == route) return c;
  FAIL("there is no case " << name);
  return {};
}

}  // namespace

// Of 200 intervals of 95 %, fewer than 178 or all 200 hold by chance in 0.02 % and 0.004 %
// (binomial).
TEST_CASE("coverage: 95 % intervals of a and b hold the truth, no run is far off, on every route",
          "[fit]") {
  using rolling::Route;
  const std::pair<const char*, Route> cases[] = {
      {"white x", Route::position},         {"white v", Route::velocity},
      {"v from x, known", Route::velocity}, {"v by Capstone", Route::velocity},
      {"x to 1 mm", Route::position},       {"x, 1 % outliers", Route::position},
      {"D from x, W 15", Route::shift},     {"D from x, W 9", Route::loglog}};
  for (const auto& [name, route] : cases) {
    const auto row = coverage::measure(find(name, route), coverage::CR, 200, 42);
    CAPTURE(name, row.bias_a, row.bias_b, row.sd_b, row.cover_a, row.cover_b, row.refused);
    CHECK(row.cover_a >= 0.89);
    CHECK(row.cover_b >= 0.89);
    CHECK(row.cover_b < 1);
    CHECK(row.far == 0);
    CHECK(std::abs(row.bias_b) <
          0.33);  // in sd of one run: 0.1, and 3.3 times the chance 1/sqrt(200)
    if (row.over_bound > 0)
      CHECK(row.over_bound < 1.17);  // 1.0, and 3.3 times the scatter 1/sqrt(400) of a spread
  }
}

// Without what the logarithm adds to the noise of a small D, 0.73 of 1000 intervals of this case
// hold; with it 0.98.
TEST_CASE("coverage: the errors of loglog hold what the bent logarithm adds to the noise",
          "[fit]") {
  const auto row =
      coverage::measure(find("D from x, W 5", rolling::Route::loglog), coverage::CF, 200, 42);
  CAPTURE(row.cover_a, row.cover_b);
  CHECK(row.cover_a >= 0.89);
  CHECK(row.cover_b >= 0.89);
}
