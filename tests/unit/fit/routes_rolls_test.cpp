// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/routes.h"

#include "fit/refits.h"
#include "fit/fitted.h"
#include "unit/catch.h"
#include "unit/fit/simulated.h"
#include "unit/many.h"

using namespace rolling;

namespace {

const Body cylinder{1.375, 0.04, 0.5};

/// The largest amount, in variances of a residual, by which a law with another exponent, held
/// within two standard errors of the one that was found, lowers the sum of squares.
double lower_by_another_exponent(Route route, const Run& run) {
  const Fitted found = fit_route(route, {run}, {});
  const auto n = static_cast<double>(found.minimum.f.size() - found.minimum.theta.size());
  const double sigma = std::sqrt(uncertainty_of(found).covariance[1][1]);
  double most = 0;
  for (double step = -2; step <= 2; step += 0.25) {
    FitOptions held;
    held.fixed[1] = found.coefficients[1].value + step * sigma;
    const double rss = fit_route(route, {run}, held).minimum.rss;
    most = std::max(most, (1 - rss / found.minimum.rss) * n);
  }
  return most;
}

Run speeds(double b, simulated::Noise& noise, double size) {
  const auto truth = simulated::roll(cylinder, 1e-3, b, 0.5);
  Run run{};
  run.body = cylinder;
  for (double t = 0; t < 3 || truth.v(t - 0.3) > 0; t += 0.05) {
    run.t.push_back(t);
    run.v.push_back(truth.v(t) + noise(size));
  }
  return run;
}

}  // namespace

// The speed of the last row before the stop changes without bound as the stop passes it.
TEST_CASE("cusps: no exponent that is held fits speeds better than the one that is found",
          "[fit][many]") {
  simulated::Noise noise(46);
  for (const double b : {-0.6, -0.3, -0.05, 0.0, 0.2})
    for (unsigned k = 0; k < of_many(40); ++k) {
      const Run run = speeds(b, noise, k % 2 ? 5e-3 : 2e-2);
      CAPTURE(b, k);
      CHECK(lower_by_another_exponent(Route::velocity, run) < 0.1);
      if (k < of_many(10)) {
        Run shifts = simulated::shifts(cylinder, run.t, run.v, 5);
        shifts.body = cylinder;
        CHECK(lower_by_another_exponent(Route::shift, shifts) < 0.1);
      }
    }
}

// The stop of each run of a joint fit is searched for, and that of a body on a slope.
TEST_CASE("cusps: of runs in both directions on a slope as well", "[fit][many]") {
  simulated::Noise noise(47);
  FitOptions options;
  options.fit_slope = true;
  for (unsigned k = 0; k < of_many(20); ++k) {
    Run up = speeds(-0.3, noise, 5e-3), down = speeds(-0.3, noise, 5e-3);
    for (double& v : down.v) v = -v;
    const Fitted found = fit_route(Route::velocity, {up, down}, options);
    for (const double b : {-0.34, -0.32, -0.3, -0.28, -0.26}) {
      FitOptions held = options;
      held.fixed[1] = b;
      const double rss = fit_route(Route::velocity, {up, down}, held).minimum.rss;
      CAPTURE(k, b);
      CHECK(rss > found.minimum.rss * (1 - 0.1 / static_cast<double>(found.minimum.f.size())));
    }
  }
}

// The differences by which the stop is followed would begin with a shift beyond the radius. D is
// constant here, and so is the deceleration.
TEST_CASE("cusps: a roll whose shift is just within the radius keeps its minimum", "[fit]") {
  Body body = cylinder;
  body.slope = 0.01;
  const double D = body.R * (1 - 1e-7), v0 = 0.5, theta = std::atan(body.slope),
               rate = body.g * (D / body.R * std::cos(theta) + std::sin(theta)) / (body.K + 1);
  Run run{};
  run.body = body;
  for (int i = 0; i < 50; ++i) {
    run.t.push_back(0.002 * i);
    run.v.push_back(std::max(0.0, v0 - rate * run.t.back()));
  }
  REQUIRE(run.v.back() == 0);
  const Fitted found = fit_route(Route::velocity, {run}, {});
  CHECK(found.coefficients[0].value == Approx(D).epsilon(1e-6));
  CHECK(std::abs(found.coefficients[1].value) < 1e-6);
}

TEST_CASE("rolls: the squares of a joint fit of shifts are those of all runs", "[fit]") {
  const auto truth = simulated::roll(cylinder, 5.75e-4, 0.1, 0.5);
  simulated::Noise noise(5);
  std::vector<double> t, v;
  for (int i = 0; i < 60; ++i) {
    t.push_back(0.04 * i);
    v.push_back(truth.v(t.back()) + noise(1e-3));
  }
  const Run run = simulated::shifts(cylinder, t, v, 5);
  const FitResult one = fit(Route::shift, {run}, {}), both = fit(Route::shift, {run, run}, {});
  const auto squares = [](const FitResult& r, double parameters) {
    return r.rms * r.rms * (static_cast<double>(r.n) - parameters);
  };
  // a, b and v0 of each run
  CHECK(std::abs(squares(both, 4) / squares(one, 3) - 2) < 1e-9);
}
