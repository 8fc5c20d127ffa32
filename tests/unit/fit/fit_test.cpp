// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "unit/fit/simulated.h"
#include "unit/catch.h"

using namespace rolling;

// Shifts with AR(1) errors: of these 200 runs, classical 95 % intervals cover 122.
TEST_CASE("fit: correlated residuals are noticed, and the errors grow", "[fit]") {
  simulated::Noise noise(5);
  int noticed = 0, covered = 0;
  double variances = 0, squares = 0;
  constexpr int runs = 200;
  for (int k = 0; k < runs; ++k) {
    Run run{};
    double error = noise(0.1);
    for (int i = 0; i < 200; ++i) {
      const double v = 0.1 + 0.005 * i;
      error = 0.7 * error + noise(0.1);
      run.v.push_back(v);
      run.D.push_back(2 * std::sqrt(v) + error);
    }
    const auto r = fit(Route::shift, {run}, {});
    noticed += r.errors == Errors::autocorrelation;
    covered += std::abs(r.b - 0.5) < 1.96 * r.sigma_b;
    variances += r.sigma_b * r.sigma_b, squares += (r.b - 0.5) * (r.b - 0.5);
  }
  CAPTURE(variances / squares);
  CHECK(noticed == runs);
  CHECK(covered >= 178);                            // fewer of 95 % by chance in 0.02 %
  CHECK(std::abs(variances / squares - 1) < 0.32);  // 3.3 times the scatter sqrt(2/200)
}

// Speeds behind an exponential filter, which has run for long before the first row, lag by one row
// here: without room for that their v0 is 3.6 standard uncertainties off, and 0.12 of the intervals
// hold it.
TEST_CASE("fit: the error of v0 has room for the delay of a filter of speeds", "[fit]") {
  simulated::Noise noise(8);
  const Body body{1, 0.04, 0.5};
  const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.5);
  double squares = 0;
  double excess = 0;
  constexpr int runs = 60;
  for (int k = 0; k < runs; ++k) {
    Run run;
    run.body = body;
    double filtered = truth.v(0) + 0.02 * 0.2309;
    for (int i = 0; i < 100; ++i) {
      const double t = 0.02 * i;
      filtered = (filtered + truth.v(t) + noise(0.005)) / 2;
      run.t.push_back(t);
      run.v.push_back(filtered);
    }
    const auto r = fit(Route::velocity, {run}, {});
    REQUIRE(r.errors == Errors::autocorrelation);
    const double off = (r.v0[0].value - truth.v(0)) / r.v0[0].sigma;
    excess += off / runs;
    squares += off * off / runs;
  }
  CHECK(excess > 0.5);
  CHECK(squares < 1.8);
}

// Of 60 rows with a correlation of a half one in five does not show it beyond doubt.
TEST_CASE("fit: the errors allow for a correlation that is not sure enough for a warning",
          "[fit]") {
  simulated::Noise noise(6);
  int silent = 0, covered = 0;
  for (int k = 0; k < 1000; ++k) {
    Run run{};
    double error = noise(0.115);
    for (int i = 0; i < 60; ++i) {
      const double v = 0.1 + 0.015 * i;
      error = 0.5 * error + noise(0.1);
      run.v.push_back(v);
      run.D.push_back(2 * std::sqrt(v) + error);
    }
    const auto r = fit(Route::shift, {run}, {});
    if (noise_is_correlated(r)) continue;
    ++silent;
    covered += std::abs(r.b - 0.5) < 1.96 * r.sigma_b;
  }
  CHECK(silent > 100);
  CHECK(covered > 0.74 * silent);  // 173 of 220; with errors of white noise 149
}

TEST_CASE("fit: fewer than 20 rows have classical errors, whatever their residuals", "[fit]") {
  Run run{};
  for (int i = 1; i < 20; ++i)
    run.v.push_back(i), run.D.push_back(i + (i < 7 || i > 13 ? 0.5 : -0.5));
  CHECK(fit(Route::shift, {run}, {}).errors == Errors::classical);
  run.v.push_back(20);
  run.D.push_back(20.5);
  CHECK(fit(Route::shift, {run}, {}).errors == Errors::autocorrelation);
}

// Fewer rows have errors of white noise: rolling-fits(7) says how many of their intervals hold.
TEST_CASE("fit: 20 speeds show that they are means of others", "[fit]") {
  const Body body{1.375, 0.04, 0.5};
  const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.5);
  simulated::Noise noise(18);
  const auto share_that_holds = [&](std::size_t rows, bool means) {
    int covered = 0;
    int runs = 0;
    for (int k = 0; k < 100; ++k) {
      std::vector<double> t;
      std::vector<double> v;
      for (std::size_t i = 0; i < rows + 2; ++i) {
        t.push_back(1.6 / static_cast<double>(rows) * static_cast<double>(i));
        v.push_back(truth.v(t.back()) + noise(0.005));
      }
      Run run{};
      run.body = body;
      for (std::size_t i = 1; i <= rows; ++i) {
        run.t.push_back(t[i]);
        run.v.push_back(means ? (v[i - 1] + v[i] + v[i + 1]) / 3 : v[i]);
      }
      try {
        const auto r = fit(Route::velocity, {run}, {});
        covered += std::abs(r.a - 1.87e-3) < 1.96 * r.sigma_a;
        ++runs;
      } catch (const Error& error) {
        CHECK(error.kind == LooseExponent);  // a large error of b is no knowledge
      }
    }
    CHECK(runs >= 90);
    return covered / static_cast<double>(runs);
  };
  CHECK(share_that_holds(20, false) > 0.87);
  CHECK(share_that_holds(20, true) > 0.87);
  CHECK(std::abs(share_that_holds(19, true) - 0.7) < 0.1);
}

// Speeds whose raw noise is not white: an AR(1) with 0.8. What the filters say is then too small,
// and is not believed.
TEST_CASE("fit: known filters of a noise that is not white have the errors of the autocorrelation",
          "[fit]") {
  const Body body{1.375, 0.04, 0.5};
  const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.5);
  simulated::Noise noise(8);
  int noticed = 0, covered = 0;
  for (int k = 0; k < 100; ++k) {
    Run run{};
    run.body = body;
    double error = noise(0.005);
    for (int i = 0; i < 220; ++i) {
      error = 0.8 * error + noise(0.003);
      run.t.push_back(0.01 * i);
      run.v.push_back(truth.v(0.01 * i) + error);
    }
    run.filters = {simulated::smooth_v(5)};
    run.v = run.filters[0].apply(run.t, run.v);
    const auto r = fit(Route::velocity, {run}, {});
    noticed += r.errors == Errors::autocorrelation;
    covered += std::abs(r.b - 0.215) < 1.96 * r.sigma_b;
  }
  CHECK(noticed == 100);
  CHECK(covered >= 85);  // fewer of 95 % by chance in 0.01 %; by the filters alone some 50
}

// Differences have taken the mean of the noise, as the fit of x0 does: without it counted the
// errors of known differences were 12 % smaller than those of the positions.
TEST_CASE("fit: correlated noise gives positions and their known differences the same errors",
          "[fit]") {
  const Body body{1.375, 0.04, 0.5};
  const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.5);
  simulated::Noise noise(8);
  double ratios = 0;
  constexpr int runs = 50;
  for (int k = 0; k < runs; ++k) {
    Run run{};
    run.body = body;
    double error = noise(3e-4);
    for (int i = 0; i < 60; ++i) {
      error = 0.8 * error + noise(1.8e-4);
      run.t.push_back(0.04 * i);
      run.x.push_back(truth.x(0.04 * i) + error);
    }
    const auto by_x = fit(Route::position, {run}, {});
    run.filters = {simulated::differentiate(Quantity::x, Quantity::v)};
    run.v = simulated::slope(run.t, run.x);
    const auto by_v = fit(Route::velocity, {run}, {});
    ratios += by_v.sigma_b / by_x.sigma_b / runs;
  }
  CAPTURE(ratios);
  CHECK(std::abs(ratios - 1) < 1e-3);
}
