// SPDX-License-Identifier: GPL-3.0-or-later
#include <gsl/gsl_cdf.h>

#include "base/error.h"
#include "unit/catch.h"
#include "unit/fit/rolls.h"
#include "unit/many.h"

using namespace rolling;
using rolls::cylinder, rolls::felt, rolls::roll, rolls::rubber;

TEST_CASE("agreement: a mat that is 1 mm a metre off level shows in two directions", "[fit]") {
  simulated::Noise noise(32);
  for (int k = 0; k < 20; ++k) {
    const std::vector<Run> runs{roll(felt, 1e-3, 1, noise), roll(felt, 1e-3, -1, noise)};
    const auto r = fit(Route::position, runs, {});
    REQUIRE(r.agreement);
    CHECK_FALSE(r.agreement->agree());
    CHECK(r.agreement->run == 0);
    // Up the slope the body seems to roll on a mat with (1 + K) R S/(1 + K) = R S more shift, down
    // with as much less.
    const double D = felt.a * std::pow(r.agreement->speed, felt.b), by_slope = 0.04 * 1e-3;
    CHECK(std::abs(r.agreement->log_D.value - std::log((D + by_slope) / (D - by_slope))) < 0.01);
    CHECK(std::abs(r.a - felt.a) < 1.96 * r.sigma_a);
    CHECK(r.sigma_a < felt.a);
    // With the slope as a parameter they agree; one degree of freedom is left.
    FitOptions options;
    options.fit_slope = true;
    const auto level = fit(Route::position, runs, options);
    CHECK(level.agreement->dof == 1);
    if (k < 5) CHECK(level.agreement->p > 1e-3);
  }
}

// Their errors are those of the joint fit, times the root of chi^2/dof.
TEST_CASE("agreement: a run with as many rows as parameters shows no noise", "[fit]") {
  simulated::Noise noise(46);
  FitOptions options;
  options.fit_slope = true;
  std::vector<Run> runs{roll({0.8 * rubber.a, rubber.b}, 1e-3, 1, noise),
                        roll(rubber, 1e-3, -1, noise)};
  const auto two = fit(Route::position, runs, options);
  runs.push_back(roll(rubber, 1e-3, 1, noise));
  for (auto* column : {&runs[2].t, &runs[2].x}) column->resize(4);
  const auto three = fit(Route::position, runs, options);
  CHECK_FALSE(three.agreement->agree());
  CHECK(std::abs(three.sigma_a / two.sigma_a - 1) < 0.2);
  CHECK(std::abs(three.scene[0]->sigma / two.scene[0]->sigma - 1) < 0.2);
}

TEST_CASE("agreement: runs of which only the common slope is unknown have no law to compare",
          "[fit]") {
  simulated::Noise noise(45);
  FitOptions options;
  options.fixed[0] = felt.a, options.fixed[1] = felt.b, options.v0 = 0.5, options.x0 = 0,
  options.fit_slope = true;
  const std::vector<Run> runs{roll(felt, 1e-3, 1, noise), roll(felt, 1e-3, 1, noise)};
  const auto r = fit(Route::position, runs, options);
  CHECK_FALSE(r.agreement);
  CHECK(std::abs(r.scene[0]->value - 1e-3) < 4 * r.scene[0]->sigma);
}

// Of seven rolls up and one down the mean of a hangs on the slope, which is found from their
// scatter.
TEST_CASE("agreement: the errors allow for scatter from run to run beside a slope", "[fit][many]") {
  simulated::Noise noise(36);
  FitOptions options;
  options.fit_slope = true;
  const unsigned sets = of_many(80);
  unsigned a = 0;
  unsigned b = 0;
  unsigned told = 0;
  for (unsigned k = 0; k < sets; ++k) {
    std::vector<Run> runs;
    for (const double way : {1, 1, 1, 1, 1, 1, 1, -1})
      runs.push_back(roll({felt.a * (1 + noise(0.02)), felt.b}, 1e-3, way, noise));
    const auto r = fit(Route::position, runs, options);
    REQUIRE(r.agreement);
    CHECK(r.agreement->dof == 13);
    a += std::abs(r.a - felt.a) < 1.96 * r.sigma_a;
    b += std::abs(r.b - felt.b) < 1.96 * r.sigma_b;
    told += !r.agreement->agree();
  }
  CAPTURE(a, b);
  CHECK(told == sets);
  for (const unsigned covered : {a, b}) {
    CHECK(covered >= at_least(sets, 0.95));
    CHECK(covered <= at_most(sets, 0.95));
  }
}

// R S acts like a shift, which bends ln D(v) where D is not constant: where the scatter of a puts
// the slope off, b is off by R b/D of that, and its error holds that of the slope.
TEST_CASE("agreement: the exponents of the runs are those at the slope that is found", "[fit]") {
  simulated::Noise noise(42);
  FitOptions options;
  options.fit_slope = true;
  std::vector<Run> runs;
  for (const auto& [by, way] : {std::pair(0.98, 1), {1.01, 1}, {1.03, 1}, {1.02, -1}})
    runs.push_back(roll({by * rubber.a, rubber.b}, 1e-3, way, noise, 1e-6));
  const auto r = fit(Route::position, runs, options);
  REQUIRE_FALSE(r.agreement->agree());
  const double D = rubber.a * std::pow(0.25, rubber.b), by_slope = 0.5 * 0.04 * rubber.b / D;
  CHECK((r.b - rubber.b) / (by_slope * (r.scene[0]->value - 1e-3)) == Approx(1).epsilon(0.15));
  CHECK(r.sigma_b > 0.9 * by_slope * r.scene[0]->sigma);
  CHECK(r.sigma_b < 1.5 * by_slope * r.scene[0]->sigma);
}

// The error of the slope is that of a difference of two means in ln D, times D/(2 R): 2 rolls up
// and 2 down leave two degrees of freedom. D is that of the speeds of the rolls, not that of 1 m/s.
TEST_CASE("agreement: the error of the slope where b is held, by hand", "[fit]") {
  simulated::Noise noise(47);
  FitOptions options;
  options.fit_slope = true;
  options.fixed[1] = 0.5;
  std::vector<Run> runs;
  for (const auto& [by, way] : {std::pair(-0.05, 1), {0.05, 1}, {-0.03, -1}, {0.03, -1}})
    runs.push_back(roll({rubber.a * std::exp(by), 0.5}, 0, way, noise, 1e-5));
  const auto r = fit(Route::position, runs, options);
  REQUIRE_FALSE(r.agreement->agree());
  const double way_to_stop = runs[0].x.back() - runs[0].x.front(),
               D = rubber.a * std::sqrt(way_to_stop / runs[0].t.back()),
               scatter = std::sqrt(2 * (0.05 * 0.05 + 0.03 * 0.03) / 2),
               student = gsl_cdf_tdist_Pinv(0.975, 2) / gsl_cdf_ugaussian_Pinv(0.975);
  CHECK(r.scene[0]->sigma == Approx(student * scatter * D / (2 * 0.04)).epsilon(0.05));
}

// What the runs scatter by is no slope: in one direction it is found by its part of each roll
// alone.
TEST_CASE("agreement: the scatter of runs in one direction does not tell a slope", "[fit]") {
  simulated::Noise noise(39);
  FitOptions options;
  options.fit_slope = true;
  for (unsigned k = 0; k < of_many(10); ++k) {
    std::vector<Run> runs;
    for (int i = 0; i < 4; ++i)
      runs.push_back(roll({rubber.a * (1 + noise(0.01)), rubber.b}, 1e-3, 1, noise, 1e-4));
    try {
      const auto r = fit(Route::position, runs, options);
      CHECK(std::abs(r.scene[0]->value - 1e-3) < 4 * r.scene[0]->sigma);
      CHECK(std::abs(r.a - rubber.a) < 4 * r.sigma_a);
    } catch (const Error&) {  // not determined
    }
  }
}

// A body that was hardly moved tells nothing of the law: beside four rolls that disagree, two such
// runs must not change what the four tell of the slope.
TEST_CASE("agreement: runs mostly at rest do not count where a slope is fitted", "[fit]") {
  simulated::Noise noise(41);
  FitOptions options;
  options.fit_slope = true;
  constexpr double slope = 1e-3;
  const unsigned sets = of_many(40);
  unsigned held = 0;
  unsigned near = 0;
  for (unsigned k = 0; k < sets; ++k) {
    std::vector<Run> runs;
    for (const double way : {1, -1, 1, -1})
      runs.push_back(roll({rubber.a * (1 + noise(0.03)), rubber.b}, slope, way, noise));
    const FitResult four = fit(Route::position, runs, options);
    for (const double way : {1, -1}) {
      Run& run = runs.emplace_back();
      run.body = cylinder;
      Body seen = cylinder;
      seen.slope = way * slope;
      Roll truth(seen, rubber, 0.02);
      for (int i = 0; i < 8; ++i) {
        run.t.push_back(0.06 * i);
        run.x.push_back(way * truth.at(run.t.back()).x + noise(3e-4));
      }
    }
    const FitResult six = fit(Route::position, runs, options);
    held += std::abs(six.scene[0]->value - slope) < 1.96 * six.scene[0]->sigma;
    near += std::abs(six.scene[0]->value - four.scene[0]->value) < 2 * four.scene[0]->sigma;
  }
  CHECK(near >= at_least(sets, 0.97));
  CHECK(held >= at_least(sets, 0.95));
}
