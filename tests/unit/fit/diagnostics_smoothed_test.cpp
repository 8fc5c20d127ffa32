// SPDX-License-Identifier: GPL-3.0-or-later
// Speeds that turn back against the motion less often than their noise would make them.
#include "base/median.h"
#include "statistics/levels.h"
#include "unit/catch.h"
#include "unit/fit/rolls.h"
#include "unit/many.h"

using namespace rolls;

namespace {

/// White speeds at 25 Hz, with the noise of differences of positions.
Run speeds(PowerLaw law, unsigned seed) {
  simulated::Noise noise(seed);
  Run run = roll(law, 0, 1, noise, 0);
  const simulated::Roll truth = simulated::roll(cylinder, law.a, law.b, 0.5);
  for (const double t : run.t) run.v.push_back(truth.v(t) + noise(5.3e-3));
  return run;
}

double reversals(const Run& run) { return fit(Route::velocity, {run}, {}).reversals; }

}  // namespace

TEST_CASE("medians of speeds turn back too rarely, white speeds do not", "[many]") {
  for (const PowerLaw law : {rubber, felt}) {
    const unsigned runs = of_many(200);
    unsigned white = 0;
    unsigned medians = 0;
    for (unsigned seed = 1; seed <= runs; ++seed) {
      Run run = speeds(law, seed);
      white += reversals(run) <= levels::few_reversals;
      run.v = medians_of_five(run.v);
      medians += reversals(run) <= levels::few_reversals;
    }
    INFO(white << " and " << medians << " of " << runs);
    CHECK(white <= at_most(runs, 0.01));
    CHECK(medians >= 3 * runs / 4);
  }
}

TEST_CASE("reversals depend not on the direction of motion, and add up over runs") {
  Run run = speeds(rubber, 3);
  run.v = medians_of_five(run.v);
  const double p = reversals(run);
  CHECK(p < levels::few_reversals);
  Run back = run;
  for (double& v : back.v) v = -v;
  CHECK(reversals(back) == Approx(p).epsilon(1e-6));
  CHECK(fit(Route::velocity, {run, back}, {}).reversals < p);
}

TEST_CASE("positions, which move by many times their noise, have no reversals to miss") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    simulated::Noise noise(seed);
    const Run run = roll(seed % 2 ? rubber : felt, 0, 1, noise);
    CHECK(fit(Route::position, {run}, {}).reversals > levels::few_reversals);
  }
}
