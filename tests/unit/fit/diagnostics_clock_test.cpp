// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/fit.h"
#include "unit/catch.h"
#include "unit/fit/simulated.h"

#include <cmath>

using namespace rolling;

namespace {

const Body body{1, 0.04, 0.5};
constexpr double step = 0.04;

/// Positions of a roll on rubber at the times of a clock that is late by `lost` seconds from row
/// `at` on, with white noise of this size.
Run run_of(double lost, std::size_t at, simulated::Noise& noise, std::size_t rows = 50,
           double size = 3e-4) {
  const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.5);
  Run run;
  run.body = body;
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = step * static_cast<double>(i);
    run.t.push_back(t);
    run.x.push_back(truth.x(t + (i < at ? 0 : lost)) + noise(size));
  }
  return run;
}

}  // namespace

TEST_CASE("clock: lost and doubled frames are found, with their time", "[fit]") {
  simulated::Noise noise(3);
  for (const double lost : {step, -step}) {
    double off = 0;
    for (const std::size_t at : {5u, 20u, 30u}) {
      const auto r = fit(Route::position, {run_of(lost, at, noise)}, {});
      REQUIRE(r.clock_jump);
      CHECK(r.clock_jump->time == step * static_cast<double>(at));
      off += (r.clock_jump->by - lost) / 3;
    }
    CHECK(std::abs(off) < 4e-3);  // the jump has bent the roll from which it is measured
  }
}

TEST_CASE("clock: it jumps in none of 300 good runs, nor in those of another law", "[fit][many]") {
  simulated::Noise noise(5);
  int jumps = 0;
  for (int k = 0; k < 300; ++k)
    jumps += fit(Route::position, {run_of(0, 0, noise)}, {}).clock_jump.has_value();
  CHECK(jumps <= 2);  // 0.3 are expected
  // Through dry friction and a wall of air: D = 0.5 mm + 8 mm (v in m/s)^2, by steps of 1 ms.
  Run run;
  run.body = body;
  double v = 0.5;
  double x = 0;
  for (int i = 0; i < 2000; ++i) {
    if (i % 40 == 0) {
      run.t.push_back(1e-3 * i);
      run.x.push_back(x + noise(1e-4));
    }
    x += 1e-3 * v;
    v -= 1e-3 * (5e-4 + 8e-3 * v * v) * body.g / (1.5 * body.R);
  }
  CHECK_FALSE(fit(Route::position, {run}, {}).clock_jump);
}

TEST_CASE("clock: a jump has to be half a step and beyond the noise", "[fit]") {
  const auto seen = [](double lost, double size) {
    simulated::Noise noise(6);
    int jumps = 0;
    for (int k = 0; k < 30; ++k)
      jumps += fit(Route::position, {run_of(lost, 25, noise, 50, size)}, {}).clock_jump.has_value();
    return jumps;
  };
  CHECK(seen(0.6 * step, 1e-4) >= 28);
  CHECK(seen(0.4 * step, 1e-4) == 0);
  CHECK(seen(step, 1e-3) >= 28);
  CHECK(seen(step, 1e-2) <= 1);  // the jump is 11 mm
}

TEST_CASE("clock: times with errors make noise as large as the speed", "[fit]") {
  const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.5);
  simulated::Noise noise(7);
  constexpr int runs = 40;
  int named = 0;
  double sum = 0;
  int uneven = 0;
  int of_others = 0;
  for (int k = 0; k < runs; ++k) {
    Run run;
    run.body = body;
    Run other = run;
    for (int i = 0; i < 200; ++i) {
      const double t = 0.01 * i;
      run.t.push_back(t);
      run.x.push_back(truth.x(t + noise(3e-3)) + noise(1e-4));
      other.t.push_back(t);
      other.x.push_back(truth.x(t) + noise(1e-4 * (1 + t)));  // grows towards the end
    }
    const auto r = fit(Route::position, {run}, {});
    REQUIRE(r.errors == Errors::uneven);
    named += r.clock_noise > 0;
    sum += r.clock_noise;
    const auto of_other = fit(Route::position, {other}, {});
    uneven += of_other.errors == Errors::uneven;
    of_others += of_other.clock_noise > 0;
  }
  CHECK(named >= 38);
  CHECK(std::abs(sum / named - 3e-3) < 1.5e-4);  // each has 5 %, besides the noise of positions
  CHECK(uneven >= 36);
  CHECK(of_others == 0);
}
