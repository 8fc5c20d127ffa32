// SPDX-License-Identifier: GPL-3.0-or-later
// Intervals that were visited: where 1.96 standard errors are none, a fit says so.
#include "fit/refits.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fit/fit.h"
#include "motion/roll.h"
#include "unit/catch.h"
#include "unit/fit/simulated.h"
#include "unit/many.h"

using namespace rolling;

namespace {

struct Scene {
  const char* name;
  std::size_t law;
  std::vector<double> c;
  Body body;
  double v0, end, dt, noise;
  double rest = 0;  // the time after the stop
};

/// Of runs of a scene: how often an interval of coefficient j is told, and how often the interval
/// that is valid, the told one or that of 1.96 standard errors, holds the truth.
struct Count {
  int told = 0;
  int held = 0;
};

Count count(const Scene& scene, std::size_t j, int runs) {
  const LawForm& form = laws()[scene.law];
  Roll truth(scene.body, Law(form, scene.c), scene.v0);
  simulated::Noise noise(1);
  FitOptions options;
  options.law = &form;
  Count all;
  for (int k = 0; k < runs; ++k) {
    Run run;
    run.body = scene.body;
    for (double t = 0; t < std::min(scene.end, truth.stop_time() + scene.rest); t += scene.dt) {
      run.t.push_back(t);
      run.x.push_back(truth.at(t).x + noise(scene.noise));
    }
    const FitResult r = fit(Route::position, {run}, options);
    const Estimate c = r.coefficients[j];
    const bool linear = std::abs(c.value - scene.c[j]) < 1.96 * c.sigma;
    const auto at = std::ranges::find(r.not_visited, j, &Interval::number);
    const bool told = at != r.not_visited.end();
    all.told += told;
    all.held += told ? at->lower < scene.c[j] && scene.c[j] < at->upper : linear;
  }
  return all;
}

const Body cylinder{1, 0.04, 0.5};
const Body ball{1, 0.11, 0.4};

}  // namespace

TEST_CASE("visited intervals: those of good runs are intervals, and none is told", "[fit]") {
  const Scene scenes[] = {{"rubber", 0, {1.87e-3, 0.215}, cylinder, 0.5, 2.3, 0.04, 3e-4},
                          {"felt", 0, {5.75e-4, 0.0244}, cylinder, 0.5, 5, 0.04, 3e-4},
                          {"three", 3, {8e-4, 3e-4, 3e-4}, ball, 1.8, 5, 1. / 30, 3e-4}};
  for (const Scene& scene : scenes)
    for (std::size_t j = 0; j < scene.c.size(); ++j) {
      CAPTURE(scene.name, j);
      const Count found = count(scene, j, 40);
      CHECK(found.told == 0);
      CHECK(found.held >= 33);  // of 40 with .95: fewer in 1 of 1000
    }
}

// Of 40 intervals of 95 % fewer than 33 hold the truth in 1 of 1000.
TEST_CASE("visited intervals: of a curved valley the profile's are told, and hold", "[fit]") {
  const Scene relaxation{"relaxation", 6, {4e-4, 9e-4, 0.3}, cylinder, 0.5, 2, 0.04, 3e-4};
  const int runs = static_cast<int>(of_many(80));
  const auto most = static_cast<int>(at_least(static_cast<unsigned>(runs), 0.95));
  const Count w = count(relaxation, 2, runs);
  CHECK(w.told >= 3 * runs / 4);
  CHECK(w.held >= most);
  const Scene both{"d0 + a v^b", 5, {8e-4, 7e-4, 1.5}, ball, 1.8, 5, 1. / 30, 3e-4};
  for (const std::size_t j : {0u, 1u}) {
    const Count found = count(both, j, runs);
    CHECK(found.told >= 19 * runs / 20);
    CHECK(found.held >= most);
  }
}

// Uphill a law with b = 0 may hold the body where it stops, and one with b < 0 does so too: b = 0
// is no wall there, and no end of an interval.
TEST_CASE("visited intervals: a mat that holds the body is no wall at b = 0", "[fit]") {
  Body up = cylinder;
  up.slope = 0.02;
  const Scene stops{"stops", 0, {1.611e-3, 0}, up, 0.5, 5, 0.04, 3e-4, 1.5};
  for (const std::size_t j : {0u, 1u}) {
    const Count found = count(stops, j, 60);
    CAPTURE(j, found.told);
    CHECK(found.held >= 50);  // of 60 with .95: fewer in 1 of 1000
  }
}

// Up a slope and back, with b = 0: b cannot be less, but a and the slope can, with b = 0.
TEST_CASE("visited intervals: at the wall of b the others go on along it", "[fit]") {
  Body up{1, 0.02, 0.4};
  up.slope = 0.03;
  Roll truth(up, PowerLaw{1e-4, 0}, 0.5);
  simulated::Noise noise(11);
  FitOptions options;
  options.fit_slope = true;
  for (int k = 0; k < 5; ++k) {
    Run run;
    run.body = {1, 0.02, 0.4};
    for (int i = 0; i < 120; ++i) {
      run.t.push_back(0.02 * i);
      run.x.push_back(truth.at(run.t.back()).x + noise(4e-4));
    }
    const FitResult r = fit(Route::position, {run}, options);
    const Estimate numbers[] = {r.coefficients[0], {}, *r.scene[0]};
    CHECK(std::ranges::count(r.not_visited, 1U, &Interval::number) == 1);
    for (const Interval& found : r.not_visited) {
      CAPTURE(k, found.number, found.lower, found.upper);
      if (found.number == 1) continue;
      const Estimate& x = numbers[found.number];
      CHECK(found.lower < x.value - x.sigma);
      CHECK(found.upper > x.value + x.sigma);
    }
  }
}

// If ln a is normal with a standard deviation of s, the sum of squares at a(1 +- 1.96 s) has risen
// by (ln(1 +- 1.96 s)/s)^2: at the lower end by more than 1.35 times 3.84 from s = 0.146 on.
TEST_CASE("visited intervals: an a with more than a seventh of error has no interval", "[fit]") {
  for (const double size : {0.12, 0.17}) {
    Run run;
    run.t = {0};
    run.body = cylinder;
    FitOptions options;
    options.fixed[1] = 0;
    // D of rows that scatter by so much that the mean has this relative error.
    constexpr int n = 50;
    for (int i = 0; i < n; ++i) {
      run.v.push_back(0.1 + 0.01 * i);
      run.D.push_back(1e-3 * (1 + (i % 2 ? 1 : -1) * size * std::sqrt(n)));
    }
    run.t.resize(n);
    std::iota(run.t.begin(), run.t.end(), 0.0);
    const FitResult r = fit(Route::shift, {run}, options);
    CAPTURE(size, r.a, r.sigma_a);
    CHECK(r.not_visited.empty() == (r.sigma_a / r.a < 0.146));
  }
}
