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

// In runs as short as these the fit leaves correlations that differ from lag to lag: each of v0 and
// x0 takes its share of one run alone.
TEST_CASE("errors: the residuals of many short runs are as white as their noise", "[fit]") {
  const Body cylinder{1.375, 0.04, 0.5};
  const auto truth = simulated::roll(cylinder, 1.87e-3, 0.215, 0.5);
  simulated::Noise noise(11);
  int not_white_by_x = 0, not_white_by_D = 0, twentieth = 0;
  constexpr int fits = 100;
  for (int k = 0; k < fits; ++k) {
    std::vector<FitRun> runs, shifts;
    for (int r = 0; r < 10; ++r) {
      FitRun run{};
      run.body = cylinder;
      for (int i = 0; i < 12; ++i) {
        run.t.push_back(0.19 * i);
        run.x.push_back(truth.x(run.t.back()) + noise(3e-4));
      }
      shifts.push_back(simulated::shifts(cylinder, run.t, run.x, 3, "x"));
      runs.push_back(std::move(run));
    }
    const double p = fit(Route::position, runs, {}).whiteness;
    not_white_by_x += p <= not_white;
    twentieth += p <= 0.05;
    not_white_by_D += fit(Route::shift, shifts, {}).whiteness <= not_white;
  }
  CHECK(not_white_by_x <= 4);  // more of 100 at 0.6 %, two tests of 0.3 %, by chance in 0.05 %
  CHECK(not_white_by_D <= 4);
  CHECK(twentieth <= 22);  // more at 10 % by chance in 0.02 %
}
