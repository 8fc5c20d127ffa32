// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/refits.h"

#include <gsl/gsl_cdf.h>

#include <cmath>
#include <functional>

#include "fit/fitted.h"
#include "base/error.h"
#include "unit/catch.h"
#include "unit/fit/simulated.h"

using namespace rolling;

namespace {

const Body cylinder{1.375, 0.04, 0.5};

/// Positions on felt every 40 ms; the speed stays for `hand` seconds.
Run held(double hand, simulated::Noise& noise, double AR = 0) {
  const auto truth = simulated::roll(cylinder, 5.75e-4, 0.0244, 0.5);
  Run run{};
  run.body = cylinder;
  double error = 0;
  for (int i = 0; i < 120; ++i) {
    const double t = 0.04 * i;
    error = AR * error + noise(3e-4);
    run.t.push_back(t);
    run.x.push_back(0.5 * std::min(t, hand) + truth.x(std::max(0.0, t - hand)) + error);
  }
  return run;
}

Run without_first(Run run, std::size_t k) {
  for (auto* column : {&run.t, &run.x})
    column->erase(column->begin(), column->begin() + static_cast<std::ptrdiff_t>(k));
  return run;
}

}  // namespace

// The squares that go with the first rows are those of two fits, with and without them. The
// noise is that of the others or, where it is larger, that in the second differences of the first
// k + 5 rows, without those of a free roll.
TEST_CASE("beginning: the chance is that of Chow's F of two fits", "[fit]") {
  simulated::Noise noise(4);
  for (int i = 0; i < 5; ++i) {
    const Run run = held(0.3, noise);
    const auto found = disturbed_beginning(Route::position, {run}, {});
    REQUIRE(found);
    CHECK(found->run == 0);
    CHECK(found->time == Approx(0.04 * static_cast<double>(found->rows)));
    const double k = static_cast<double>(found->rows), left = 120 - 4 - k;
    const double all = fit_route(Route::position, {run}, {}).minimum.rss,
                 rest =
                     fit_route(Route::position, {without_first(run, found->rows)}, {}).minimum.rss;
    const std::size_t near = found->rows + 5;
    const double of_roll = -0.04 * 0.04 * 5.75e-4 * std::pow(0.5, 0.0244) * 9.81 / (1.5 * 0.04);
    double local = 0;
    for (std::size_t j = 2; j < near; ++j)
      local += std::pow(run.x[j] - 2 * run.x[j - 1] + run.x[j - 2] - of_roll, 2);
    const double variance = std::max(rest / left, local / (6 * static_cast<double>(near - 2)));
    constexpr double tests = 5;  // the first 3, 5, 8, 13 and 21 rows
    const double chance = tests * gsl_cdf_fdist_Q((all - rest) / variance / k, k, left);
    CHECK(std::log(found->p) == Approx(std::log(chance)).epsilon(0.01));
  }
}

TEST_CASE("beginning: in joint fits the run that shows it is named", "[fit]") {
  simulated::Noise noise(5);
  const std::vector<Run> runs{held(0, noise), held(0.3, noise), held(0, noise)};
  const auto found = disturbed_beginning(Route::position, runs, {});
  REQUIRE(found);
  CHECK(found->run == 1);
}

// The joint law has errors from the noisier run. Each of the two runs has five tests.
TEST_CASE("beginning: in joint fits a run is judged by its own law", "[fit]") {
  simulated::Noise noise(11);
  for (int i = 0; i < 10; ++i) {
    const Run run = held(0.3, noise);
    Run other = held(0, noise);
    for (double& x : other.x) x += noise(3e-3);
    const auto alone = disturbed_beginning(Route::position, {run}, {}),
               found = disturbed_beginning(Route::position, {other, run}, {});
    REQUIRE(found.has_value() == alone.has_value());
    if (!alone) continue;  // its other rows do not look white
    CHECK(found->run == 1);
    CHECK(found->rows == alone->rows);
    CHECK(found->time == alone->time);
    CHECK(found->p / alone->p == Approx(2).epsilon(1e-6));
  }
}

TEST_CASE("beginning: a run that has no parameters of its own is not tested", "[fit]") {
  simulated::Noise noise(12);
  FitOptions options;
  options.fixed[0] = 5.75e-4, options.fixed[1] = 0.0244, options.v0 = 0.5, options.x0 = 0;
  options.fit_slope = true;
  const std::vector<Run> runs{held(0.3, noise), held(0.3, noise)};
  CHECK_FALSE(disturbed_beginning(Route::position, runs, options));
}

// Of 200 with a chance of 0.1 %, 4 or more come in 1 of 17,000.
TEST_CASE("beginning: noise that is larger at first, or in one run, is no hand", "[fit][many]") {
  simulated::Noise noise(9), more(10);
  const auto with = [&](const std::function<double(int)>& sigma) {
    Run run = held(0, noise);
    for (std::size_t i = 0; i < run.x.size(); ++i) run.x[i] += more(sigma(static_cast<int>(i)));
    return run;
  };
  const auto even = [&](double sigma) { return with([=](int) { return sigma; }); };
  int at_first = 0, falling = 0, in_one = 0;
  for (int i = 0; i < 200; ++i) {
    const Run first = with([](int k) { return k < 26 ? 1e-3 : 0; }),
              less = with([](int k) { return 3e-3 * (1 - k / 130.0); });
    at_first += disturbed_beginning(Route::position, {first}, {}).has_value();
    falling += disturbed_beginning(Route::position, {less}, {}).has_value();
    in_one += disturbed_beginning(Route::position, {even(0), even(0), even(1e-3)}, {}).has_value();
  }
  CHECK(at_first <= 3);
  CHECK(falling <= 3);
  CHECK(in_one <= 3);
}

// Of 300 with a chance of 0.1 %, 4 or more come in 1 of 3000.
TEST_CASE("beginning: free rolls, noise of long memory and fits of no roll show none", "[fit]") {
  simulated::Noise noise(6);
  int free = 0, of_memory = 0;
  for (int i = 0; i < 300; ++i) {
    free += disturbed_beginning(Route::position, {held(0, noise)}, {}).has_value();
    of_memory += disturbed_beginning(Route::position, {held(0, noise, 0.95)}, {}).has_value();
  }
  CHECK(free <= 3);
  CHECK(of_memory <= 30);  // in most of them the others are not white either
  Run curve{};
  for (int i = 0; i < 60; ++i) {
    curve.v.push_back(0.5 - 0.005 * i);
    curve.D.push_back(i < 5 ? 0 : 6e-4 + noise(1e-5));
  }
  CHECK_FALSE(disturbed_beginning(Route::shift, {curve}, {}));
  Run few = held(0.3, noise);
  for (auto* column : {&few.t, &few.x}) column->resize(23);
  CHECK_FALSE(disturbed_beginning(Route::position, {few}, {}));
}

// Filters spread a hand of 0.3 s over all residuals, which are not white then.
TEST_CASE("beginning: in columns of known filters the test for white residuals sees it", "[fit]") {
  simulated::Noise noise(7);
  for (double hand : {0.3, 0.0}) {
    const Run raw = held(hand, noise);
    Run run = simulated::shifts(cylinder, raw.t, raw.x, 5, "x");
    run.body = cylinder;
    CHECK_FALSE(disturbed_beginning(Route::shift, {run}, {}));
    CHECK((fit(Route::shift, {run}, {}).whiteness < 0.005) == (hand > 0));
  }
}

// Speeds of rolls of two to nine rows and a long rest: without the first rows nothing, or
// nothing but rounding, determines the roll.
TEST_CASE("beginning: rows that alone determine the roll cannot be tested", "[fit]") {
  simulated::Noise noise(8);
  int found = 0;
  for (int k = 0; k < 300; ++k) {
    Run run{};
    run.body = cylinder;
    for (int i = 0; i < 60; ++i) {
      run.t.push_back(0.1 * i);
      run.v.push_back(std::max(0.0, 0.1 * (2 + k % 8 - 0.5 - i)) + noise(1e-2));
    }
    try {
      found += disturbed_beginning(Route::velocity, {run}, {}).has_value();
    } catch (const Error&) {  // two rows do not always determine a roll
    }
  }
  CHECK(found <= 3);  // of 300 with a chance of 0.1 %
}
