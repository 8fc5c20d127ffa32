// SPDX-License-Identifier: GPL-3.0-or-later
// Joint fits of runs with hardly more rows than parameters.

#include <algorithm>
#include <random>

#include "base/error.h"
#include "law/law.h"
#include "unit/catch.h"
#include "unit/fit/simulated.h"

using namespace rolling;

namespace {

/// Speeds of 5 to 8 positions over the roll and perhaps a rest behind it, by filters that are
/// known.
Run short_run(const Body& body, PowerLaw law, std::mt19937_64& random, simulated::Noise& noise) {
  const auto uniform = [&](double from, double to) {
    return from + (to - from) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  const auto truth = simulated::roll(body, law.a, law.b, uniform(0.15, 0.8));
  const double time = std::pow(truth.v0, 1 - law.b) / (law.a * truth.c),
               size = std::pow(10, uniform(-5, -2.5));
  const std::size_t n = 5 + random() % 4;
  Run run{};
  run.body = body;
  const double end = time * uniform(0.5, 2.5);
  for (std::size_t i = 0; i < n; ++i) {
    run.t.push_back(end * static_cast<double>(i) / static_cast<double>(n - 1));
    run.x.push_back(truth.x(run.t.back()) + noise(size));
  }
  run.filters = {simulated::differentiate(Quantity::x, Quantity::v), simulated::smooth_v(5)};
  run.v = run.filters[1].apply(run.t, run.filters[0].apply(run.t, run.x));
  return run;
}

}  // namespace

// A run of so few rows may have no variance that can be estimated. Its law is then no weight.
TEST_CASE("joint fit: the order of the runs does not matter, and the errors are above 0", "[fit]") {
  const Body body{1.375, 0.04, 0.5};
  int fitted = 0;
  for (unsigned seed = 1; seed <= 150; ++seed) {
    std::mt19937_64 random(seed);
    simulated::Noise noise(seed);
    const PowerLaw law{1e-3, 0.2};
    std::vector<Run> runs;
    for (std::size_t k = 2 + seed % 4; k > 0; --k)
      runs.push_back(short_run(body, law, random, noise));
    FitResult one{}, other{};
    try {
      one = fit(Route::velocity, runs, {});
      std::ranges::reverse(runs);
      other = fit(Route::velocity, runs, {});
    } catch (const Error&) {  // too little is determined
      continue;
    }
    ++fitted;
    CAPTURE(seed, one.a, one.b, other.b);
    CHECK(one.sigma_a > 1e-9 * one.a);
    CHECK(one.sigma_b > 1e-9);
    CHECK(other.sigma_a == Approx(one.sigma_a).epsilon(1e-3));
    CHECK(other.sigma_b == Approx(one.sigma_b).epsilon(1e-3));
    CHECK(std::abs(other.a - one.a) < 1e-3 * one.sigma_a);
  }
  CHECK(fitted > 75);
}
