#include "base/error.h"
#include "fit/covariance.h"
#include "unit/fit/simulated.h"
#include "unit/catch.h"

using namespace rolling;

// Ordinary least squares of (ln x, ln y) of NIST's DanWood, with 25 digits in
// reference-data/nist/README.md.
TEST_CASE("loglog: DanWood's line to 13 digits", "[fit]") {
  FitRun run{};
  run.v = {1.309, 1.471, 1.490, 1.565, 1.611, 1.680};
  run.D = {2.138, 3.421, 3.597, 4.340, 4.882, 5.660};
  const auto r = fit(Route::loglog, {run}, {});
  CHECK(std::abs(r.a / 0.7499453471479073351399504 - 1) < 1e-13);
  CHECK(std::abs(r.b / 3.91720563648151597911981 - 1) < 1e-13);
  CHECK(std::abs(r.sigma_a / (0.7499453471479073351399504 * 0.01788365137880371529413) - 1) <
        1e-13);
  CHECK(std::abs(r.sigma_b / 0.0421987655476501635748 - 1) < 1e-13);
  CHECK(std::abs(r.rms / std::sqrt(0.0002707997228804226607321 / 4) - 1) < 1e-13);
}

TEST_CASE("loglog: records without a logarithm are left out and counted; none left is refused",
          "[fit]") {
  FitRun run{};
  run.v = {1, 2, 4, 0, -1, 3};
  run.D = {3, 6, 12, 1, 1, -1};
  const auto r = fit(Route::loglog, {run}, {});
  CHECK(r.n == 3);
  CHECK(r.left_out == 3);
  CHECK(std::abs(r.a - 3) < 1e-13);
  CHECK(std::abs(r.b - 1) < 1e-13);
  run.D = {-3, -6, 0, 1, 1, -1};
  CHECK_THROWS_AS(fit(Route::loglog, {run}, {}), Error);
}

TEST_CASE("loglog: a held exponent leaves the mean of the logarithms", "[fit]") {
  FitRun run{};
  run.v = {1, 2, 4};
  run.D = {3, 7, 11};
  FitOptions options;
  options.b = 0;
  CHECK(std::abs(fit(Route::loglog, {run}, options).a / std::cbrt(3 * 7 * 11.0) - 1) < 1e-14);
}

TEST_CASE("loglog: a held coefficient, squares and bisquare alike", "[fit]") {
  FitRun run{};
  for (int i = 1; i <= 40; ++i)
    run.v.push_back(0.05 * i), run.D.push_back(3 * std::pow(0.05 * i, 0.7));
  FitOptions options;
  options.a = 3;
  for (const bool robust : {false, true}) {
    options.robust = robust;
    CHECK(std::abs(fit(Route::loglog, {run}, options).b - 0.7) < 1e-12);
  }
}

TEST_CASE(
    "loglog: correlated residuals of two runs have the errors of their autocorrelation, by the "
    "sums of a line",
    "[fit]") {
  simulated::Noise noise(8);
  std::vector<FitRun> runs(2);
  std::vector<double> log_v, log_D;
  for (FitRun& run : runs) {
    double error = 0;
    for (int i = 1; i <= 100; ++i) {
      error = 0.7 * error + noise(0.05);
      run.v.push_back(0.01 * i);
      run.D.push_back(2 * std::sqrt(0.01 * i) * std::exp(error));
      log_v.push_back(std::log(run.v.back()));
      log_D.push_back(std::log(run.D.back()));
    }
  }
  const auto r = fit(Route::loglog, runs, {});
  REQUIRE(r.errors == Errors::autocorrelation);
  constexpr double n = 200;
  double x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < 200; ++i) x += log_v[i] / n, y += log_D[i] / n;
  for (std::size_t i = 0; i < 200; ++i)
    xx += (log_v[i] - x) * (log_v[i] - x), xy += (log_v[i] - x) * (log_D[i] - y);
  CHECK(std::abs(r.b / (xy / xx) - 1) < 1e-12);
  CHECK(std::abs(r.a / std::exp(y - xy / xx * x) - 1) < 1e-12);
  std::vector<double> residuals, scores;  // of the slope: its column over its length
  for (std::size_t i = 0; i < 200; ++i) {
    residuals.push_back(y + r.b * (log_v[i] - x) - log_D[i]);
    scores.push_back(residuals.back() * (log_v[i] - x) / std::sqrt(xx));
  }
  const std::size_t each[] = {100, 100};
  const auto middle = newey_west(scores, 2, residuals, each);
  CHECK(std::abs(r.sigma_b / std::sqrt((middle[0] + middle[1]) * n / (n - 2) / xx) - 1) < 1e-10);
}

TEST_CASE(
    "loglog: noise of a third of D does not bend the law, for what it does to the mean logarithm "
    "is known",
    "[fit]") {
  const Body body{1, 0.04, 0.5};
  const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.5);
  std::vector<FitRun> runs;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    simulated::Noise noise(seed);
    FitRun& run = runs.emplace_back();
    run.body = body;
    for (int i = 0; i < 1500; ++i) {
      run.t.push_back(0.001 * i);
      run.v.push_back(truth.v(run.t.back()) + noise(9e-4));
    }
    run.filters = {simulated::smooth_v(11), simulated::differentiate("v", "a"),
                   simulated::shift(body)};
    run.v = simulated::mean(run.v, 11);
    run.D = run.filters[2].apply(run.t, simulated::slope(run.t, run.v));
  }
  const auto r = fit(Route::loglog, runs, {});
  const double at = 0.3, size = r.a * std::pow(at, r.b) / (1.87e-3 * std::pow(at, 0.215));
  INFO("a " << r.a << " +- " << r.sigma_a << ", b " << r.b << " +- " << r.sigma_b << ", D(" << at
            << ") " << size << " times the true one, left out " << r.left_out);
  CHECK(std::abs(size - 1) < 0.01);
}
