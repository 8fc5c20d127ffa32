#include "fit/errors.h"

#include "unit/fit/simulated.h"
#include "unit/catch.h"

using namespace rolling;

// sum of squares of the records of each group over its square: HC3 of means is known by hand.
TEST_CASE("errors: HC3 of a mean of uneven noise is the sum of squares over (n - 1)^2", "[fit]") {
  simulated::Noise noise(9);
  FitRun run{};
  double sum = 0;
  constexpr int n = 60;
  for (int i = 0; i < n; ++i) {
    run.v.push_back(1);
    run.D.push_back(5 + noise(0.02 + 0.02 * i));
    sum += run.D.back();
  }
  FitOptions options;
  options.b = 0;
  const auto r = fit(Route::shift, {run}, options);
  REQUIRE(r.errors == Errors::uneven);
  double squares = 0;
  for (double D : run.D) squares += (D - sum / n) * (D - sum / n);
  CHECK(std::abs(r.a / (sum / n) - 1) < 1e-13);
  CHECK(std::abs(r.sigma_a / (std::sqrt(squares) / (n - 1)) - 1) < 1e-10);
}

TEST_CASE("errors: two runs of different noise have the errors of both", "[fit]") {
  simulated::Noise noise(10);
  std::vector<FitRun> runs(2);
  double sum = 0, squares = 0;
  constexpr int n = 120;
  for (int i = 0; i < n; ++i) {
    FitRun& run = runs[static_cast<std::size_t>(i % 2)];
    run.v.push_back(1);
    run.D.push_back(5 + noise(i % 2 ? 0.3 : 0.1));
    sum += run.D.back();
  }
  FitOptions options;
  options.b = 0;
  const auto r = fit(Route::shift, runs, options);
  REQUIRE(r.errors == Errors::uneven);
  for (const FitRun& run : runs)
    for (double D : run.D) squares += (D - sum / n) * (D - sum / n);
  CHECK(std::abs(r.sigma_a / (std::sqrt(squares) / (n - 1)) - 1) < 1e-10);
}
