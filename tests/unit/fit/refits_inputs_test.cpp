// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/studies.h"
#include "motion/roll.h"
#include "unit/catch.h"
#include "unit/fit/simulated.h"
#include "unit/many.h"

using namespace rolling;

namespace {

const Body cylinder{1.375, 0.04, 0.5},
    with_errors{
        .m = 1.375, .R = 0.04, .K = 0.5, .sigma_R = 2e-4, .sigma_K = 0.005, .sigma_g = 0.02};

double share(const FitResult& r, const std::string& of, std::size_t coefficient) {
  for (const ErrorShare& s : r.shares)
    if (s.of == of) return s.sigma(coefficient);
  return -1;
}

/// A noisy roll on rubber as positions or speeds, or as shifts whose filters are known.
Run made_run(Route route, unsigned seed) {
  const auto truth = simulated::roll(cylinder, 1.87e-3, 0.215, 0.5);
  simulated::Noise noise(seed);
  Run run{};
  for (int i = 0; i < 60; ++i) {
    run.t.push_back(0.04 * i);
    run.v.push_back(truth.v(0.04 * i) + noise(2e-3));
    run.x.push_back(truth.x(0.04 * i) + noise(3e-4));
  }
  if (route == Route::shift || route == Route::loglog)
    run = simulated::shifts(cylinder, run.t, run.x, 9, "x");
  run.body = with_errors;
  if (run.shift_of) run.shift_of = with_errors;
  return run;
}

}  // namespace

// With A = 1 only g/((1 + K) R) counts: D is proportional to (1 + K) R/g, on every route.
TEST_CASE("input quantities: ln a moves by dK/(1 + K), dR/R and dg/g, b does not", "[fit]") {
  for (Route route : {Route::loglog, Route::shift, Route::velocity, Route::position})
    for (bool filters_known : {true, false}) {
      Run run = made_run(route, 3);
      if (!filters_known) run.filters.clear();
      const auto r = fit(route, {run}, {});
      run.body = cylinder;
      if (run.shift_of) run.shift_of = cylinder;
      const auto by_noise = fit(route, {run}, {});
      CAPTURE(static_cast<int>(route), filters_known);
      // By the logarithm of noise; or by noise of the speeds beside shifts without filters.
      const bool biased = route == (filters_known ? Route::loglog : Route::shift);
      REQUIRE(r.shares.size() == (biased ? 5 : 4));
      REQUIRE(by_noise.shares.size() == (biased ? 2 : 1));
      const double K = 0.005 / 1.5, R = 2e-4 / 0.04, g = 0.02 / 9.81;
      CHECK(std::abs(share(r, "K", 0) / r.a / K - 1) < 1e-3);
      CHECK(std::abs(share(r, "R", 0) / r.a / R - 1) < 1e-3);
      CHECK(std::abs(share(r, "g", 0) / r.a / g - 1) < 1e-3);
      for (const char* of : {"K", "R", "g"}) CHECK(share(r, of, 1) < 1e-5 * r.sigma_b);
      CHECK(share(r, "noise", 0) == by_noise.shares[0].sigma(0));
      const double all = by_noise.sigma_a * by_noise.sigma_a + r.a * r.a * (K * K + R * R + g * g);
      CHECK(std::abs(r.sigma_a / std::sqrt(all) - 1) < 1e-3);
      CHECK(std::abs(r.corr * r.sigma_a / (by_noise.corr * by_noise.sigma_a) - 1) < 1e-3);
      if (!r.v0.empty()) CHECK(std::abs(r.v0[0].sigma / by_noise.v0[0].sigma - 1) < 1e-5);
    }
}

TEST_CASE("input quantities: on a level mat the shares are those of fits with other numbers",
          "[fit]") {
  for (Route route : {Route::loglog, Route::shift, Route::velocity, Route::position}) {
    Run run = made_run(route, 3);
    const auto level = fit(route, {run}, {});
    // A slope that changes nothing, but lets the numbers be moved and the rows fitted again.
    run.body.slope = 1e-12;
    if (run.shift_of) run.shift_of->slope = 1e-12;
    const auto all_but_level = fit(route, {run}, {});
    CAPTURE(static_cast<int>(route));
    REQUIRE(level.shares.size() == all_but_level.shares.size());
    for (const char* of : {"K", "R", "g"}) {
      const double moved = share(all_but_level, of, 0);
      CHECK(std::abs(share(level, of, 0) / moved - 1) < 1e-5);
    }
    for (std::size_t i = 0; i < level.shares.size(); ++i)
      CHECK(level.shares[i].covariance.size() == all_but_level.shares[i].covariance.size());
  }
}

TEST_CASE("input quantities: runs of one body move together, those of two apart", "[fit]") {
  std::vector<Run> runs{made_run(Route::position, 3), made_run(Route::position, 4)};
  for (Run& run : runs) run.body = cylinder, run.body.sigma_K = 0.005;
  const auto one = fit(Route::position, runs, {});
  REQUIRE(one.shares.size() == 2);
  CHECK(std::abs(share(one, "K", 0) / one.a / (0.005 / 1.5) - 1) < 1e-3);
  // The same rows, as if of two bodies that are all but the same: each moves about half.
  runs[1].body.K = 0.5 + 1e-9;
  const auto two = fit(Route::position, runs, {});
  REQUIRE(two.shares.size() == 3);
  CHECK(std::abs((two.shares[1].sigma(0) + two.shares[2].sigma(0)) / one.shares[1].sigma(0) - 1) <
        1e-2);
  CHECK(two.shares[1].sigma(0) > 0.3 * one.shares[1].sigma(0));
  CHECK(two.shares[2].sigma(0) > 0.3 * one.shares[1].sigma(0));
}

// The law of runs that disagree is the mean of theirs, in which runs that scatter by more than
// their noise have equal weights. K of half of them moves ln a of each by dK/(1 + K), and no b.
TEST_CASE("input quantities: where runs disagree their shares are those of the mean", "[fit]") {
  simulated::Noise noise(46);
  std::vector<Run> runs;
  for (const auto& [by, K] : {std::pair(0.95, 0.5), {1.07, 0.5}, {0.92, 0.83}, {1.04, 0.83}}) {
    Run& run = runs.emplace_back();
    run.body = cylinder;
    run.body.K = K;
    run.body.sigma_K = K == 0.5 ? 0.0 : 0.05;
    const double size = K == 0.5 ? 1e-4 : 3e-4;  // one law for all would follow the cylinder
    const auto truth = simulated::roll(run.body, by * 1.87e-3, 0.215, 0.5);
    for (double t = 0; t < 2; t += 0.02) {
      run.t.push_back(t);
      run.x.push_back(truth.x(t) + noise(size));
    }
  }
  const auto r = fit(Route::position, runs, {});
  REQUIRE_FALSE(r.agreement->agree());
  CHECK(share(r, "K", 0) / r.a == Approx(0.05 / 1.83 / 2).epsilon(0.03));
  CHECK(share(r, "K", 1) < 1e-3);
}

TEST_CASE("input quantities: what is held fixed has no error from them", "[fit]") {
  FitOptions options;
  options.fixed[0] = 1.87e-3;
  const auto r = fit(Route::position, {made_run(Route::position, 3)}, options);
  CHECK(r.sigma_a == 0);
  CHECK(r.corr == 0);
  CHECK(r.sigma_b > share(r, "noise", 1));
}

// The short form of a table of `make coverage`. A spread of 2000 draws scatters by 1.6 %.
TEST_CASE("input quantities: errors and correlation of Monte Carlo draws", "[fit][many]") {
  const unsigned draws = of_many(2000);
  const double off = 2.7 / std::sqrt(draws);
  const auto all = studies::input_quantities(static_cast<int>(draws), 8);
  CAPTURE(all.stated_a, all.a.sd(), all.stated_b, all.b.sd(), all.stated_v0, all.v0.sd(),
          all.stated_corr, all.corr);
  CHECK(std::abs(all.stated_a / all.a.sd() - 1) < off);
  CHECK(std::abs(all.stated_b / all.b.sd() - 1) < off);
  CHECK(std::abs(all.stated_v0 / all.v0.sd() - 1) < off);
  CHECK(std::abs(all.stated_corr - all.corr) < off / 2);
  // No given number is a trifle here.
  for (const char* of : {"K", "R", "slope"}) CHECK(share(all.first, of, 0) > 0.2 * all.stated_a);
}
