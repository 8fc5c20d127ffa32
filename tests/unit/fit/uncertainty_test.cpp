// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/refits.h"

#include "cli/history.h"
#include "unit/fit/simulated.h"
#include "unit/catch.h"

using namespace rolling;

// sum of squares of the rows of each group over its square: HC3 of means is known by hand.
TEST_CASE("errors: HC3 of a mean of uneven noise is the sum of squares over (n - 1)^2", "[fit]") {
  simulated::Noise noise(9);
  Run run{};
  double sum = 0;
  constexpr int n = 60;
  for (int i = 0; i < n; ++i) {
    run.v.push_back(1);
    run.D.push_back(5 + noise(0.02 + 0.02 * i));
    sum += run.D.back();
  }
  FitOptions options;
  options.fixed[1] = 0;
  const auto r = fit(Route::shift, {run}, options);
  REQUIRE(r.errors == Errors::uneven);
  double squares = 0;
  for (double D : run.D) squares += (D - sum / n) * (D - sum / n);
  CHECK(std::abs(r.a / (sum / n) - 1) < 1e-13);
  CHECK(std::abs(r.sigma_a / (std::sqrt(squares) / (n - 1)) - 1) < 1e-10);
}

TEST_CASE("errors: two runs of different noise have the errors of both", "[fit]") {
  simulated::Noise noise(10);
  std::vector<Run> runs(2);
  double sum = 0, squares = 0;
  constexpr int n = 120;
  for (int i = 0; i < n; ++i) {
    Run& run = runs[static_cast<std::size_t>(i % 2)];
    run.v.push_back(1);
    run.D.push_back(5 + noise(i % 2 ? 0.3 : 0.1));
    sum += run.D.back();
  }
  FitOptions options;
  options.fixed[1] = 0;
  const auto r = fit(Route::shift, runs, options);
  REQUIRE(r.errors == Errors::uneven);
  for (const Run& run : runs)
    for (double D : run.D) squares += (D - sum / n) * (D - sum / n);
  CHECK(std::abs(r.sigma_a / (std::sqrt(squares) / (n - 1)) - 1) < 1e-10);
}

// In runs as short as these the fit leaves correlations that differ from lag to lag: each of v0 and
// x0 takes its share of one run alone.
TEST_CASE("errors: the residuals of many short runs are as white as their noise", "[fit]") {
  const Body cylinder{1.375, 0.04, 0.5};
  const auto truth = simulated::roll(cylinder, 1.87e-3, 0.215, 0.5);
  simulated::Noise noise(11);
  int not_white_by_x = 0, not_white_by_D = 0, twentieth = 0;
  constexpr int fits = 100;
  for (int k = 0; k < fits; ++k) {
    std::vector<Run> runs, shifts;
    for (int r = 0; r < 10; ++r) {
      Run run{};
      run.body = cylinder;
      for (int i = 0; i < 12; ++i) {
        run.t.push_back(0.19 * i);
        run.x.push_back(truth.x(run.t.back()) + noise(3e-4));
      }
      shifts.push_back(simulated::shifts(cylinder, run.t, run.x, 3, "x"));
      runs.push_back(std::move(run));
    }
    const double p = fit(Route::position, runs, {}).whiteness;
    not_white_by_x += p <= levels::not_white;
    twentieth += p <= 0.05;
    not_white_by_D += fit(Route::shift, shifts, {}).whiteness <= levels::not_white;
  }
  CHECK(not_white_by_x <= 4);  // more of 100 at 0.6 %, two tests of 0.3 %, by chance in 0.05 %
  CHECK(not_white_by_D <= 4);
  CHECK(twentieth <= 22);  // more at 10 % by chance in 0.02 %
}

namespace {

/// Speeds from positions, by filters that are known, with white noise of their own that is ten
/// times what the filters leave of the noise of the positions.
Run rounded_speeds(double a, simulated::Noise& noise) {
  Run run{};
  run.body = {1.375, 0.04, 0.5};
  const auto truth = simulated::roll(run.body, a, 0.215, 0.5);
  for (int i = 0; i < 60; ++i) {
    run.t.push_back(0.03 * i);
    run.x.push_back(truth.x(run.t.back()) + noise(2e-5));
  }
  run.filters = {simulated::differentiate(Quantity::x, Quantity::v), simulated::smooth_v(11)};
  run.v = run.filters[1].apply(run.t, run.filters[0].apply(run.t, run.x));
  for (double& v : run.v) v += noise(1e-3);
  return run;
}

}  // namespace

TEST_CASE("errors: they are those of white noise that the filters have not made", "[fit]") {
  simulated::Noise noise(12);
  double squares = 0, variances = 0;
  int not_white_by_v = 0;
  constexpr int fits = 200;
  for (int k = 0; k < fits; ++k) {
    const FitResult r = fit(Route::velocity, {rounded_speeds(1.87e-3, noise)}, {});
    squares += (r.b - 0.215) * (r.b - 0.215);
    variances += r.sigma_b * r.sigma_b;
    not_white_by_v += noise_is_correlated(r);
  }
  CHECK(std::abs(std::sqrt(variances / squares) - 1) < 0.15);  // three standard deviations
  CHECK(not_white_by_v <= 5);  // more of 200 at 0.6 % by chance in 0.2 %
}

TEST_CASE("errors: runs with white noise beside that of the filters are compared", "[fit]") {
  simulated::Noise noise(13);
  int like = 0, unlike = 0;
  for (int k = 0; k < 50; ++k) {
    const Run one = rounded_speeds(1.87e-3, noise), same = rounded_speeds(1.87e-3, noise),
              other = rounded_speeds(2.06e-3, noise);
    const auto alike = fit(Route::velocity, {one, same}, {}).agreement,
               apart = fit(Route::velocity, {one, other}, {}).agreement;
    REQUIRE((alike && apart));
    like += alike->agree();
    unlike += !apart->agree();
  }
  CHECK(like >= 47);  // fewer at 1 % by chance in 0.2 %
  CHECK(unlike == 50);
}

// A polynomial of third order through all positions has a slope of three numbers.
TEST_CASE("errors: there are none where filters leave as many numbers as parameters", "[fit]") {
  const Body body{1.375, 0.04, 0.5};
  const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.5);
  for (const int order : {3, 4}) {
    simulated::Noise noise(14);
    Run run{};
    run.body = body;
    for (int i = 0; i < 12; ++i) {
      run.t.push_back(0.15 * i);
      run.x.push_back(truth.x(run.t.back()) + noise(1e-4));
    }
    const std::vector line{"differentiate x savgol width 23 order " + std::to_string(order)};
    run.filters = history_of(line, run.t).filters;
    run.v = run.filters[0].apply(run.t, run.x);
    const FitResult r = fit(Route::velocity, {run}, {});
    CAPTURE(order, r.a, r.sigma_a);
    CHECK((r.errors == Errors::none) == (order == 3));
    CHECK(std::isnan(r.sigma_a) == (order == 3));
    CHECK(std::isnan(r.rms) == (order == 3));
  }
}

// Of 8 rows the fit of v0 and x0 takes a quarter of the noise, most of it at the ends.
TEST_CASE("errors: many short runs of one noise are not said to have several", "[fit]") {
  const Body body{1.375, 0.04, 0.5};
  const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.5);
  simulated::Noise noise(15);
  int uneven = 0;
  for (int k = 0; k < 20; ++k) {
    std::vector<Run> runs;
    for (int r = 0; r < 150; ++r) {
      Run& run = runs.emplace_back();
      run.body = body;
      const int n = r % 2 ? 8 : 20;
      for (int i = 0; i < n; ++i) {
        run.t.push_back(2.0 * i / n);
        run.x.push_back(truth.x(run.t.back()) + noise(3e-4));
      }
    }
    uneven += fit(Route::position, runs, {}).errors == Errors::uneven;
  }
  CHECK(uneven <= 2);  // more of 20 at 1 % by chance in 0.1 %
}
