// SPDX-License-Identifier: GPL-3.0-or-later
// One run up a slope, over its turning point and back.
#include "fit/fit.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "fit/model.h"
#include "motion/roll.h"
#include "unit/catch.h"
#include "unit/many.h"
#include "unit/fit/simulated.h"

using namespace rolling;

namespace {

struct Scene {
  const char* name;
  double K, R, a, b, slope, end;
};

}  // namespace

// Each number is beyond 1.96 of its errors in 1 of 20: of 160 numbers of each kind more than 18 are
// in .04 %, of 32 more than 6 in .09 %.
TEST_CASE("turning run: both ways determine the slope, and a and b, towards falling x too",
          "[fit]") {
  const Scene scenes[] = {{"ball", 0.4, 0.0127, 5e-5, 0.1, 0.02, 6.2},
                          {"cart", 0.05, 0.02, 2e-4, 0.3, 0.03, 3.0},
                          {"cylinder", 0.5, 0.04, 1.87e-3, 0.215, 0.1, 1.6},
                          {"ball, hardly determined", 0.4, 0.0127, 5e-5, 0.1, 0.05, 2.7},
                          {"cylinder, slow way back", 0.5, 0.04, 1.87e-3, 0.215, 0.02, 4.4},
                          {"cylinder, long way back", 0.5, 0.04, 1.87e-3, 0.215, 0.02, 16},
                          {"cart, beyond its start", 0.05, 0.02, 2e-4, 0.3, 0.03, 6},
                          {"cylinder, 1 mm/s back", 0.5, 0.04, 1.87e-3, 0.215, 0.01, 5.4}};
  const unsigned seeds = of_many(5);
  unsigned off_a = 0;
  unsigned off_b = 0;
  unsigned off_slope = 0;
  unsigned fits = 0;
  for (const Scene& scene : scenes)
    for (const Route route : {Route::position, Route::velocity}) {
      // The short form takes each scene on one route and in one direction, in turn.
      const auto index = static_cast<unsigned>(&scene - scenes);
      if (seeds == 1 && (index % 2 == 0) != (route == Route::position)) continue;
      for (unsigned seed = 1; seed <= seeds; ++seed) {
        simulated::Noise noise(seed);
        Roll truth({1, scene.R, scene.K, 9.81, scene.slope}, PowerLaw{scene.a, scene.b}, 0.5);
        const double way = (seed + index / 2) % 2 ? 1 : -1;
        Run run{};
        run.body = {1, scene.R, scene.K};
        for (double t = 0; t < scene.end; t += 0.04) {
          const auto p = truth.at(t);
          run.t.push_back(t);
          run.x.push_back(way * p.x + noise(3e-4));
          run.v.push_back(way * p.v + noise(1e-3));
        }
        FitOptions options;
        options.fit_slope = true;
        CAPTURE(scene.name, seed, route == Route::position);
        const FitResult r = fit(route, {run}, options);
        CHECK(r.v0[0].value * way > 0);
        off_a += std::abs(r.a - scene.a) > 1.96 * r.sigma_a;
        off_b += std::abs(r.b - scene.b) > 1.96 * r.sigma_b;
        off_slope += std::abs(r.scene[0]->value - way * scene.slope) > 1.96 * r.scene[0]->sigma;
        ++fits;
      }
    }
  const unsigned most = at_most(fits, 0.05);
  CHECK(off_a <= most);
  CHECK(off_b <= most);
  CHECK(off_slope <= most);
}

TEST_CASE("turning run: without a slope it is refused, and told what it needs", "[fit]") {
  Roll truth({1, 0.0127, 0.4, 9.81, 0.02}, PowerLaw{5e-5, 0.1}, 0.5);
  simulated::Noise noise(1);
  Run run{};
  run.body = {1, 0.0127, 0.4};
  for (double t = 0; t < 6.2; t += 0.04) {
    const auto p = truth.at(t);
    run.t.push_back(t), run.x.push_back(p.x + noise(3e-4)), run.v.push_back(p.v + noise(1e-3));
  }
  for (const Route route : {Route::position, Route::velocity}) {
    std::string message;
    try {
      fit(route, {run}, {});
    } catch (const Error& error) {
      message = error.what();
    }
    CHECK(message.starts_with("the body comes back, which a level mat does not do"));
  }
  run.body.slope = 0.02;  // given
  const FitResult r = fit(Route::position, {run}, {});
  CHECK(std::abs(r.a - 5e-5) < 4 * r.sigma_a);
  CHECK(std::abs(r.b - 0.1) < 4 * r.sigma_b);
}

// For b < 0 the mat would hold the body at its turning point: the sum of squares has a wall at
// b = 0. The first scene is felt.
TEST_CASE("turning run: no fit with b held has a smaller sum of squares, at the wall b = 0 too",
          "[fit]") {
  simulated::Noise noise(1);
  const bool all = of_many(1) == 1;
  unsigned off = 0;
  unsigned fits = 0;
  for (const double b : {0.0, 0.0244, 0.003, 0.1})
    for (const double slope : {0.02, 0.03})
      for (const Route route : {Route::position, Route::velocity})
        for (int i = 0; i < 2; ++i) {
          if (!all && (i == 0) != (route == Route::position)) continue;
          Body body{1, 0.04, 0.5, 9.81, slope};
          Roll truth(body, PowerLaw{5.75e-4, b}, 0.5);
          const double way = i % 2 ? 1 : -1;
          Run run;
          run.body = body;
          run.body.slope *= way;
          for (double t = 0; t < 3.5 + 0.6 * i; t += 0.04) {
            const Roll::Point p = truth.at(t);
            run.t.push_back(t);
            run.x.push_back(way * p.x + noise(3e-4));
            run.v.push_back(way * p.v + noise(1e-3));
          }
          FitOptions options;
          const FitResult found = fit(route, {run}, options);
          CAPTURE(b, slope, way, route == Route::position);
          const auto squares = [](const FitResult& r) {
            return r.rms * r.rms * static_cast<double>(r.freedom);
          };
          for (const double held : {0.0, 0.05, 0.3}) {
            options.fixed[1] = held;
            CHECK(squares(found) < squares(fit(route, {run}, options)) * (1 + 1e-9));
          }
          off += std::abs(found.a - 5.75e-4) > 1.96 * found.sigma_a;
          ++fits;
        }
  CHECK(fits == (all ? 32 : 16));
  CHECK(off <= at_most(fits, 0.05));
}

// The way of noisy speeds at rest is a random walk.
TEST_CASE("turning run: a rest of noisy speeds is no way back, a slow way back is one", "[fit]") {
  Body mat{1, 0.04, 0.5};
  Body up = mat;
  up.slope = 0.02;
  const PowerLaw rubber{1.87e-3, 0.215};
  Roll rests(mat, rubber, 0.5);
  Roll returns(up, rubber, 0.5);
  simulated::Noise noise(4);
  for (const int n : {90, 600})
    for (int k = 0; k < 40; ++k) {
      std::vector<double> t;
      std::vector<double> at_rest;
      std::vector<double> coming_back;
      for (int i = 0; i < n; ++i) {
        t.push_back(0.04 * i);
        const double error = noise(5e-3);
        at_rest.push_back(rests.at(t.back()).v + error);
        coming_back.push_back(returns.at(std::min(4.4, t.back())).v + error);
      }
      CAPTURE(n, k);
      CHECK(way_before_turn(false, t, at_rest) == 0);
      CHECK(way_before_turn(false, t, coming_back) == 1);
    }
}
