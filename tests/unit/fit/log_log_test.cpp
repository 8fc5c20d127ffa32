#include "base/error.h"
#include "unit/fit/simulated.h"
#include "unit/catch.h"

using namespace rolling;

// Ordinary least squares of (ln x, ln y) of NIST's DanWood, with 25 digits in reference-data/nist/README.md.
TEST_CASE("loglog: DanWood's line to 13 digits", "[fit]") {
  FitRun run{};
  run.v = {1.309, 1.471, 1.490, 1.565, 1.611, 1.680};
  run.D = {2.138, 3.421, 3.597, 4.340, 4.882, 5.660};
  const auto r = fit(Route::loglog, {run}, {});
  CHECK(std::abs(r.a / 0.7499453471479073351399504 - 1) < 1e-13);
  CHECK(std::abs(r.b / 3.91720563648151597911981 - 1) < 1e-13);
  CHECK(std::abs(r.sigma_a / (0.7499453471479073351399504 * 0.01788365137880371529413) - 1) < 1e-13);
  CHECK(std::abs(r.sigma_b / 0.0421987655476501635748 - 1) < 1e-13);
  CHECK(std::abs(r.rms / std::sqrt(0.0002707997228804226607321 / 4) - 1) < 1e-13);
}

TEST_CASE("loglog: records without a logarithm are left out and counted; none left is refused", "[fit]") {
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
