// SPDX-License-Identifier: GPL-3.0-or-later
// The processor time of fits beside that of the plain fit of good runs: of `make bench` alone,
// since a busy machine would fail them.
#include <ctime>

#include "base/error.h"
#include "fit/fit.h"
#include "unit/catch.h"
#include "unit/fit/rolls.h"

using namespace rolling;
using namespace rolls;

namespace {

double seconds(const auto& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

std::vector<Run> many(PowerLaw law, int n) {
  simulated::Noise noise(7);
  std::vector<Run> runs;
  for (int r = 0; r < n; ++r) runs.push_back(roll(law, 0, 1, noise));
  return runs;
}

}  // namespace

TEST_CASE("time: all laws are compared in 13 fits of many runs", "[.][fit][time]") {
  const std::vector<Run> runs = many(rubber, 100);
  const double one = seconds([&] { fit(Route::position, runs, {}); });
  CHECK(seconds([&] { compare_laws(Route::position, runs, {}); }) < 13 * one);
}

TEST_CASE("time: a law that the runs hardly determine takes 20 fits of one that they do",
          "[.][fit][time]") {
  const std::vector<Run> runs = many(felt, 60);
  FitOptions options;
  options.law = &laws()[5];
  REQUIRE(options.law->formula == std::string("d0 + a v^b"));
  const double one = seconds([&] { fit(Route::position, many(rubber, 60), options); });
  const auto to_its_end = [&] {
    try {
      fit(Route::position, runs, options);
    } catch (const Error&) {  // refused
    }
  };
  CHECK(seconds(to_its_end) < 20 * one);
}

TEST_CASE("time: a body at rest is refused in half a second for 300,000 rows", "[.][fit][time]") {
  simulated::Noise noise(7);
  Run run{};
  run.body = cylinder;
  for (int i = 0; i < 300'000; ++i) {
    run.t.push_back(1e-3 * i);
    run.x.push_back(0.5 + noise(1e-4));
  }
  const auto refused = [&] { CHECK_THROWS_AS(fit(Route::position, {run}, {}), Error); };
  CHECK(seconds(refused) < 0.5);
}
