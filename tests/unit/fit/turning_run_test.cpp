// SPDX-License-Identifier: GPL-3.0-or-later
// One run up a slope, over its turning point and back.
#include "fit/fit.h"

#include <cmath>
#include <string>

#include "base/error.h"
#include "motion/roll.h"
#include "unit/catch.h"
#include "unit/fit/simulated.h"

using namespace rolling;

namespace {

struct Scene {
  const char* name;
  double K, R, a, b, slope, end;
};

}  // namespace

// Of 128 numbers of each kind, each beyond 1.96 of its errors in 1 of 20: rarely more than 15.
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
  int off_a = 0, off_b = 0, off_slope = 0;
  for (const Scene& scene : scenes)
    for (const Route route : {Route::position, Route::velocity})
      for (unsigned seed = 1; seed <= 8; ++seed) {
        simulated::Noise noise(seed);
        Roll truth({1, scene.R, scene.K, 9.81, scene.slope}, Geometry::approximate,
                   PowerLaw{scene.a, scene.b}, 0.5);
        const double way = seed % 2 ? 1 : -1;
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
        off_slope += std::abs(r.slope - way * scene.slope) > 1.96 * r.sigma_slope;
      }
  CHECK(off_a <= 15);
  CHECK(off_b <= 15);
  CHECK(off_slope <= 15);
}

TEST_CASE("turning run: without a slope it is refused, and told what it needs", "[fit]") {
  Roll truth({1, 0.0127, 0.4, 9.81, 0.02}, Geometry::approximate, PowerLaw{5e-5, 0.1}, 0.5);
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
