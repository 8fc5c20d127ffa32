// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "cli/history.h"
#include "motion/roll.h"
#include "unit/catch.h"
#include "unit/fit/simulated.h"

using namespace rolling;

namespace {
const Body cylinder{1.375, 0.04, 0.5};
}

TEST_CASE(
    "differences: those that nothing tells of are found by the residuals, means of speeds are not "
    "taken for them",
    "[fit]") {
  const auto truth = simulated::roll(cylinder, 5.75e-4, 0.1, 0.5);
  const LinearFilter difference = simulated::differentiate(Quantity::x, Quantity::v);
  LinearFilter mean = simulated::smooth_v(3);
  FitOptions options;
  options.possible_filters = {difference, mean};
  simulated::Noise noise(12);
  simulated::Noise other_noise(13);
  std::size_t found[4] = {}, covered = 0;
  double share = 0;  // of the errors by filters that the `##` lines would tell
  constexpr std::size_t runs = 50;
  for (std::size_t k = 0; k < runs; ++k) {
    Run run{};
    run.body = cylinder;
    std::vector<double> x, v;
    for (int i = 0; i < 120; ++i) {
      run.t.push_back(0.04 * i);
      x.push_back(truth.x(run.t.back()) + noise(3e-4));
      v.push_back(truth.v(run.t.back()) + noise(5e-3));
    }
    run.v = difference.apply(run.t, x);
    const auto r = fit(Route::velocity, {run}, options);
    found[0] += r.errors == Errors::differences;
    covered += std::abs(r.b - 0.1) < 1.96 * r.sigma_b;
    if (r.errors == Errors::differences) {
      CHECK(r.left_out == 2);  // the ends, where nobody knows what was done
      Run told = run;
      told.filters = {difference};
      share += r.sigma_b / fit(Route::velocity, {told}, {}).sigma_b;
    }
    run.v = v;
    found[1] += fit(Route::velocity, {run}, options).errors == Errors::differences;
    run.v = mean.apply(run.t, v);
    found[2] += fit(Route::velocity, {run}, options).errors == Errors::differences;
    run.t.clear();
    x.clear();
    for (int i = 0; i < 19; ++i) {
      run.t.push_back(0.25 * i);
      x.push_back(truth.x(run.t.back()) + other_noise(3e-4));
    }
    run.v = difference.apply(run.t, x);
    found[3] += fit(Route::velocity, {run}, options).errors == Errors::differences;
  }
  CHECK(found[0] >= 45);
  CAPTURE(share / static_cast<double>(found[0]));
  CHECK(std::abs(share / static_cast<double>(found[0]) - 1) < 0.1);
  CHECK(covered >= 42);  // fewer of 95 % by chance in 0.2 %
  CHECK(found[1] <= 4);
  CHECK(found[2] == 0);
  CHECK(found[3] == 0);  // too few rows
}

TEST_CASE(
    "differences: those that the first rows of a long run tell of are reckoned with in all of "
    "it",
    "[fit]") {
  const auto truth = simulated::roll(cylinder, 5.75e-4, 0.1, 0.5);
  FitOptions options;
  options.possible_filters = {simulated::differentiate(Quantity::x, Quantity::v)};
  simulated::Noise noise(5);
  Run run{};
  run.body = cylinder;
  std::vector<double> x;
  for (int i = 0; i < 5000; ++i)
    run.t.push_back(1e-3 * i), x.push_back(truth.x(run.t.back()) + noise(3e-6));
  run.v = options.possible_filters[0].apply(run.t, x);
  const auto r = fit(Route::velocity, {run}, options);
  CHECK(r.errors == Errors::differences);
  CHECK(r.n == 4998);
  CHECK(std::abs(r.b - 0.1) < 4 * r.sigma_b);
  for (double& v : run.v) v += noise(2e-3);  // as large as the noise of the differences
  CHECK(fit(Route::velocity, {run}, options).errors == Errors::differences);
}

// Differences round off the stop, and more so where b < 0: what such a roll leaves there looks like
// correlated noise, although a roll without differences fits better.
TEST_CASE(
    "differences: runs of different rates with one white noise are not taken for them, those with "
    "one noise of positions are",
    "[fit]") {
  FitOptions options;
  options.possible_filters = filters_of_sensors();
  simulated::Noise noise(3);
  std::size_t white = 0, differences = 0;
  constexpr std::size_t pairs = 60;
  for (std::size_t k = 0; k < pairs; ++k) {
    std::vector<Run> by_speed(2), by_position(2);
    for (std::size_t r = 0; r < 2; ++r) {
      const auto truth = simulated::roll(cylinder, 5.75e-4, 0.1, 0.5);
      Run& run = by_speed[r];
      run.body = cylinder;
      std::vector<double> x;
      for (int i = 0; i < (r == 0 ? 120 : 12); ++i) {
        run.t.push_back((r == 0 ? 0.025 : 0.25) * i);
        x.push_back(truth.x(run.t.back()) + noise(3e-4));
        run.v.push_back(truth.v(run.t.back()) + noise(5e-3));
      }
      by_position[r] = run;
      by_position[r].v = simulated::slope(run.t, x);
    }
    white += fit(Route::velocity, by_speed, options).left_out > 0;
    differences += fit(Route::velocity, by_position, options).left_out > 0;
  }
  CAPTURE(white, differences);
  CHECK(white <= 4);  // e^-3 of them, 3, at most
  CHECK(differences >= 54);
}

// PASCO's rule needs two readings on either side, and not that of its own row: where echoes are
// lost in every third row, single speeds stand between gaps.
TEST_CASE("differences: gaps that follow each other are gaps", "[fit]") {
  const auto truth = simulated::roll(cylinder, 5.75e-4, 0.0244, 0.5);
  FitOptions options;
  options.possible_filters = filters_of_sensors();
  const LinearFilter& pasco = options.possible_filters[4];
  simulated::Noise noise(8);
  int found = 0;
  int covered = 0;
  constexpr int runs = 40;
  for (int k = 0; k < runs; ++k) {
    std::vector<double> t;
    std::vector<double> x;
    for (int i = 0; i < 120; ++i) {
      t.push_back(0.04 * i);
      x.push_back(truth.x(t.back()) + noise(1e-3));
    }
    const std::vector<double> v = pasco.apply(t, x);
    Run run{};
    run.body = cylinder;
    for (std::size_t i = 0; i < t.size(); ++i) {
      const bool lost = i > 30 && i < 42 && i % 3 != 0;
      if (lost) continue;
      run.t.push_back(t[i]);
      run.v.push_back(v[i]);
    }
    const auto r = fit(Route::velocity, {run}, options);
    found += r.errors == Errors::differences;
    covered += std::abs(r.b - 0.0244) < 1.96 * r.sigma_b;
  }
  CAPTURE(found, covered);
  CHECK(found >= 38);
  CHECK(covered >= 34);  // fewer of 95 % by chance in 1 %
}

TEST_CASE("differences: speeds with white noise and a sudden stop are not taken for them",
          "[fit]") {
  const PowerLaw law{1e-3, -0.2};
  const auto truth = simulated::roll(cylinder, law.a, law.b, 0.5);
  Roll exact(cylinder, law, 0.5);
  FitOptions options;
  options.possible_filters = filters_of_sensors();
  simulated::Noise noise(44);
  int taken = 0, covered = 0;
  for (int k = 0; k < 200; ++k) {
    Run run{};
    run.body = cylinder;
    for (int i = 0; i < 100; ++i) {
      run.t.push_back(1.25 * exact.stop_time() / 99 * i);
      run.v.push_back(truth.v(run.t.back()) + noise(5e-4));
    }
    const auto r = fit(Route::velocity, {run}, options);
    taken += r.errors == Errors::differences;
    covered += std::abs(r.b - law.b) < 1.96 * r.sigma_b;
  }
  CAPTURE(taken, covered);
  CHECK(taken <= 8);  // more of 1.5 % by chance in 0.4 %
  CHECK(covered >= 180);
}

// On even times differences to the row before are those to the row after of another clock.
TEST_CASE("differences: to the row before or after, on even and uneven times, v0 is that of t0",
          "[fit]") {
  const auto truth = simulated::roll(cylinder, 5.75e-4, 0.1, 0.5);
  FitOptions options;
  options.possible_filters = filters_of_sensors();
  simulated::Noise noise(21);
  constexpr double clock = 3;  // [s], when the roll begins
  for (const auto& [jitter, after] : {std::pair(0.0, false),
                                      {0.1, false},
                                      {0.0, true},
                                      {0.1, true},
                                      {0.01, false},
                                      {0.01, true}}) {
    int found = 0, covered = 0, white = 0, of_v0 = 0;
    for (int k = 0; k < 50; ++k) {
      Run run{};
      run.body = cylinder;
      double before = truth.x(-0.04) + noise(3e-4);
      for (int i = 0; i < 90; ++i) {
        const double t = 0.04 * (i + std::clamp(noise(jitter), -0.4, 0.4)),
                     x = truth.x(t) + noise(3e-4);
        const double step = i == 0 ? 0.04 : clock + t - run.t.back();
        run.t.push_back(clock + t);
        run.v.push_back((x - before) / step);
        before = x;
      }
      if (after) {
        run.v.erase(run.v.begin());
        run.t.pop_back();
      }
      const auto r = fit(Route::velocity, {run}, options);
      found += r.errors == Errors::differences;
      covered += std::abs(r.b - 0.1) < 1.96 * r.sigma_b;
      white += r.whiteness > 0.003;
      CHECK(r.left_out < 10);
      CHECK(r.v0[0].sigma < 3e-3);  // half a step makes 1.8e-3
      of_v0 += std::abs(r.v0[0].value - truth.v(run.t[0] - clock)) < 1.96 * r.v0[0].sigma;
    }
    CAPTURE(jitter, after, found, covered, white, of_v0);
    CHECK(found >= 45);
    CHECK(covered >= 42);  // fewer of 95 % by chance in 0.2 %
    CHECK(white >= 47);
    CHECK(of_v0 >= 42);
  }
}

TEST_CASE("differences: no hypothesis takes the slow half of a run away", "[fit]") {
  // Speeds at the passes of a wheel, once a turn: the steps grow ten times.
  const auto truth = simulated::roll(cylinder, 5.75e-4, 0.1, 0.5);
  FitOptions options;
  options.possible_filters = filters_of_sensors();
  simulated::Noise noise(22);
  for (int k = 0; k < 20; ++k) {
    Run run{};
    run.body = cylinder;
    for (double t = 0; t < 5.2; t += 0.02 * 0.5 / std::max(truth.v(t), 0.05)) {
      run.t.push_back(t);
      run.v.push_back(truth.v(t) + noise(2e-3));
    }
    CHECK(2 * fit(Route::velocity, {run}, options).n > run.t.size());
  }
}
