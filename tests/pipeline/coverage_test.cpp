// SPDX-License-Identifier: GPL-3.0-or-later
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

// Of 400 intervals of 95 %, fewer than 363 or more than 395 hold by chance in 0.02 % each
// (binomial), and the spread of 400 estimates scatters by 3.5 %: errors that are 15 % too large or
// too small do not pass.
TEST_CASE(
    "coverage: standard errors are the spread of the estimates, 95 % intervals hold the truth",
    "[fit][many]") {
  using rolling::Route;
  const std::pair<const char*, Route> cases[] = {
      {"white x", Route::position},          {"white v", Route::velocity},
      {"v from x, known", Route::velocity},  {"x to 1 mm", Route::position},
      {"x, 1 % outliers", Route::position},  {"D from x, W 15", Route::shift},
      {"D from x, 10 % lost", Route::shift}, {"D from x, savgol 31", Route::shift},
      {"whole run, D", Route::shift}};
  for (const auto& [name, route] : cases) {
    const auto row = coverage::measure(find(name, route), coverage::CR, 400, 42);
    CAPTURE(name, row.bias_a, row.bias_b, row.sd_b, row.cover_a, row.cover_b, row.refused,
            row.sigma_a, row.sigma_b);
    for (const double cover : {row.cover_a, row.cover_b}) {
      CHECK(cover >= 363. / 400);
      CHECK(cover <= 395. / 400);
    }
    for (const double ratio : {row.sigma_a, row.sigma_b}) {
      CHECK(ratio > 0.9);
      CHECK(ratio < 1.12);
    }
    CHECK(row.far == 0);
    CHECK(row.refused == 0);
    CHECK(std::abs(row.bias_b) < 3.3 / 20);  // in sd of one run: 3.3 times the chance 1/sqrt(400)
    if (row.over_bound > 0) CHECK(std::abs(row.over_bound - 1) < 3.3 / std::sqrt(800));
  }
}

// Rounding adds little: without its part in the weights the errors came out fifty times too wide.
TEST_CASE("coverage: columns that were rounded between the filters", "[fit]") {
  for (const char* name : {"D from x, --digits 4", "D from x, --digits 3"}) {
    const auto row = coverage::measure(find(name, rolling::Route::shift), coverage::CR, 200, 42);
    CAPTURE(name, row.cover_a, row.cover_b, row.sigma_b, row.sd_b);
    for (const double cover : {row.cover_a, row.cover_b}) CHECK(cover >= 0.89);
    for (const double ratio : {row.sigma_a, row.sigma_b}) {
      CHECK(ratio > 0.9);
      CHECK(ratio < 1.7);
    }
    CHECK(row.refused == 0);
  }
}

TEST_CASE("coverage: differences that only the residuals show", "[fit]") {
  const auto row =
      coverage::measure(find("v by Capstone", rolling::Route::velocity), coverage::CR, 200, 42);
  CAPTURE(row.cover_a, row.cover_b, row.sigma_b, row.sd_b);
  for (const double cover : {row.cover_a, row.cover_b}) {
    CHECK(cover >= 0.89);
    CHECK(cover < 1);
  }
}

// Fig. 4's columns hold what the raw run held: the way by D is as precise as the trajectory,
// whatever the rate of the rows.
TEST_CASE("coverage: the way by D is as precise as the positions", "[fit][many]") {
  using rolling::Route;
  for (const auto& scene : {coverage::CR, coverage::CF})
    for (const bool fast : {false, true}) {
      const int runs = fast ? 40 : 200;
      const auto x =
          coverage::measure(find(fast ? "x, 4 kHz" : "white x", Route::position), scene, runs, 7);
      const auto D = coverage::measure(
          find(fast ? "D from x, 4 kHz" : "D from x, mean 11", Route::shift), scene, runs, 7);
      CAPTURE(scene.name, fast, x.sd_b, D.sd_b, D.percent_a);
      CHECK(D.sd_b < 1.1 * x.sd_b);
      CHECK(std::abs(D.percent_a) < 0.2);
      CHECK(D.cover_b >= 0.85);  // of 40: fewer by chance in 0.6 %
    }
}

TEST_CASE("coverage: where the noise is not what the filters say, the errors hold all the same",
          "[fit]") {
  using rolling::Route;
  const std::pair<const char*, Route> cases[] = {{"D from x, AR(1) 0.8", Route::shift},
                                                 {"x, noise grows", Route::position},
                                                 {"D from x, noise grows", Route::shift}};
  for (const auto& [name, route] : cases) {
    const auto row = coverage::measure(find(name, route), coverage::CF, 200, 42);
    CAPTURE(name, row.cover_a, row.cover_b, row.told);
    CHECK(row.told > 0.95);
    for (const double cover : {row.cover_a, row.cover_b}) {
      CHECK(cover >= 0.88);
      CHECK(cover < 1);
    }
  }
}
