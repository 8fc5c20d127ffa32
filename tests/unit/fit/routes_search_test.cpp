// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/fit.h"

#include "base/error.h"
#include "unit/catch.h"
#include "unit/fit/simulated.h"
#include "unit/many.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

using namespace rolling;

// False echoes of a sonar, 0.1 to 0.3 m off, one in ten on average. Of fits that begin with Huber's
// loss alone, 3 of 150 end at the echoes, with an rms of ten times the noise, and 8 find no end.
TEST_CASE("fit: a robust fit of 20 positions finds the law beside false echoes", "[fit][many]") {
  constexpr double noise = 3e-4;
  constexpr int n = 20;
  const unsigned runs = of_many(150);
  const Body body{1, 0.04, 0.5};
  const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.5);
  const double stop = std::pow(0.5, 1 - 0.215) / ((1 - 0.215) * 1.87e-3 * truth.c);
  simulated::Noise random(31);
  std::mt19937 echo;  // with the seed of the standard: the same echoes in each run
  const auto share = [&] { return static_cast<double>(echo()) * 0x1p-32; };
  unsigned found = 0;
  unsigned covered = 0;
  for (unsigned k = 0; k < runs; ++k) {
    Run run;
    run.body = body;
    for (int i = 0; i < n; ++i) {
      run.t.push_back(0.95 * stop * i / (n - 1));
      run.x.push_back(truth.x(run.t.back()) + random(noise));
      if (share() < 0.1) run.x.back() += (share() < 0.5 ? -1 : 1) * (0.1 + 0.2 * share());
    }
    FitOptions options;
    options.robust = true;
    const FitResult r = fit(Route::position, {run}, options);
    found += r.rms < 3 * noise;
    covered += std::abs(r.b - 0.215) < 1.96 * r.sigma_b;
  }
  CHECK(found == runs);
  CHECK(covered >= at_least(runs, 0.93));
}

// With the median of all rows for their scale a noisier run is an outlier as a whole: of these
// 20 pairs of fits 15 are refused, as no row is left of a run, and 4 have two exponents.
TEST_CASE("fit: a robust joint fit of runs of different noise, in either order", "[fit]") {
  const Body body{1, 0.04, 0.5};
  const std::pair<int, double> sizes[] = {{100, 1e-4}, {12, 3e-3}, {80, 1e-3}};
  FitOptions options;
  options.robust = true;
  const unsigned sets = of_many(20);
  unsigned covered = 0;
  for (unsigned seed = 1; seed <= sets; ++seed) {
    simulated::Noise random(seed);
    std::vector<Run> runs;
    for (const auto& [n, noise] : sizes) {
      const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.35 + 0.01 * seed);
      const double stop = std::pow(truth.v0, 1 - 0.215) / ((1 - 0.215) * 1.87e-3 * truth.c);
      Run& run = runs.emplace_back();
      run.body = body;
      for (int i = 0; i < n; ++i) {
        run.t.push_back(0.95 * stop * i / (n - 1));
        run.x.push_back(truth.x(run.t.back()) + random(noise));
      }
    }
    const FitResult one = fit(Route::position, runs, options);
    std::ranges::reverse(runs);
    const FitResult other = fit(Route::position, runs, options);
    CAPTURE(seed, one.b, one.sigma_b);
    CHECK(std::abs(one.b - other.b) < 1e-5 * one.sigma_b);
    covered += std::abs(one.b - 0.215) < 1.96 * one.sigma_b;
  }
  CHECK(covered >= at_least(sets, 0.95));
}

// The median of 30 sizes scatters by a fifth. Were it the scale of its run, 30 of these fits would
// be said to have noise of several sizes.
TEST_CASE("fit: robust joint fits of runs of one noise are not said to have several", "[fit]") {
  const Body body{1, 0.04, 0.5};
  FitOptions options;
  options.robust = true;
  simulated::Noise noise(31);
  const unsigned sets = of_many(40);
  unsigned uneven = 0;
  for (unsigned k = 0; k < sets; ++k) {
    std::vector<Run> runs;
    for (int r = 0; r < 20; ++r) {
      const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.3 + 0.02 * r);
      Run& run = runs.emplace_back();
      run.body = body;
      for (int i = 0; i < 30; ++i) {
        run.t.push_back(0.06 * i);
        run.x.push_back(truth.x(run.t.back()) + noise(3e-4));
      }
    }
    uneven += fit(Route::position, runs, options).errors == Errors::uneven;
  }
  CHECK(uneven <= at_most(sets, 0.01));
}

// The sign of x is that of the direction from the sensor: nothing but signs may depend on it.
TEST_CASE("fit: a robust fit of mirrored positions is the mirrored fit", "[fit]") {
  const Body body{1, 0.04, 0.5};
  std::mt19937 random;
  const auto share = [&] { return static_cast<double>(random()) * 0x1p-32; };
  simulated::Noise noise(32);
  FitOptions options;
  options.robust = true;
  const unsigned runs = of_many(150);
  unsigned fitted = 0;
  for (unsigned k = 0; k < runs; ++k) {
    const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.2 + 0.6 * share());
    const double stop = std::pow(truth.v0, 1 - 0.215) / ((1 - 0.215) * 1.87e-3 * truth.c);
    Run run, mirrored;
    run.body = body;
    const int n = 8 + static_cast<int>(13 * share());
    for (int i = 0; i < n; ++i) {
      run.t.push_back(0.95 * stop * i / (n - 1));
      run.x.push_back(truth.x(run.t.back()) + noise(3e-4));
      if (share() < 0.08) run.x.back() += 0.6 * share() - 0.3;
    }
    mirrored = run;
    for (double& x : mirrored.x) x *= -1;
    const auto fit_of = [&](const Run& of) -> std::optional<FitResult> {
      try {
        return fit(Route::position, {of}, options);
      } catch (const Error&) {
        return {};
      }
    };
    const auto one = fit_of(run), other = fit_of(mirrored);
    CAPTURE(k, n);
    REQUIRE(one.has_value() == other.has_value());
    if (!one) continue;
    ++fitted;
    CHECK(std::abs(one->a - other->a) < 1e-4 * one->sigma_a);
    CHECK(other->sigma_b == Approx(one->sigma_b).epsilon(1e-4));
  }
  CHECK(fitted > 2 * runs / 3);
}
