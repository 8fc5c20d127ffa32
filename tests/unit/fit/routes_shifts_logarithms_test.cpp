// SPDX-License-Identifier: GPL-3.0-or-later
#include <random>

#include "base/error.h"
#include "unit/fit/simulated.h"
#include "statistics/residuals.h"
#include "unit/catch.h"
#include "unit/normal.h"

using namespace rolling;

// Ordinary least squares of (ln x, ln y) of NIST's DanWood, computed with 25 digits.
TEST_CASE("loglog: DanWood's line to 13 digits", "[fit]") {
  Run run{};
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

TEST_CASE("loglog: rows without a logarithm are left out and counted; none left is refused",
          "[fit]") {
  Run run{};
  run.v = {1, 2, 4, 0, -1, 3, NAN};  // the last one is missing
  run.D = {3, 6, 12, 1, 1, -1, 1};
  const auto r = fit(Route::loglog, {run}, {});
  CHECK(r.n == 3);
  CHECK(r.left_out == 3);
  CHECK(std::abs(r.a - 3) < 1e-13);
  CHECK(std::abs(r.b - 1) < 1e-13);
  run.D = {-3, -6, 0, 1, 1, -1, 1};
  CHECK_THROWS_AS(fit(Route::loglog, {run}, {}), Error);
}

TEST_CASE("loglog: D <= 0 in more than one row of a hundred biases the line, whatever rms says",
          "[fit]") {
  std::mt19937 random(17);
  Normal noise;
  for (const double share : {0.2, 0.5, 1.0, 2.0}) {
    Run run{};
    std::size_t negative = 0;
    for (int i = 1; i <= 2000; ++i) {
      run.v.push_back(0.0005 * i);
      run.D.push_back(0.5 * std::pow(run.v.back(), 0.2) * (1 + share * noise(random)));
      negative += run.D.back() <= 0;
    }
    const auto r = fit(Route::loglog, {run}, {});
    CHECK(r.negative == negative);
    CHECK((negative > 20) == (share > 0.43));  // P(D <= 0) = Phi(-1/share)
    const bool biased = std::abs(std::log(r.a / 0.5)) > r.sigma_a / r.a;
    CHECK(logarithms_biased(r) == biased);
  }
  Run exact{};
  exact.v = {1, 2, 3, 4, 5, 6}, exact.D = {3, 6, -1, 12, 15, 18};
  CHECK(logarithms_biased(fit(Route::loglog, {exact}, {})));
  exact.v[2] = -3;  // it comes back: no reading of D at that speed is negative
  CHECK(!logarithms_biased(fit(Route::loglog, {exact}, {})));
}

TEST_CASE("loglog: a held exponent leaves the mean of the logarithms", "[fit]") {
  Run run{};
  run.v = {1, 2, 4};
  run.D = {3, 7, 11};
  FitOptions options;
  options.fixed[1] = 0;
  CHECK(std::abs(fit(Route::loglog, {run}, options).a / std::cbrt(3 * 7 * 11.0) - 1) < 1e-14);
}

TEST_CASE("loglog: a held coefficient, squares and bisquare alike", "[fit]") {
  Run run{};
  for (int i = 1; i <= 40; ++i)
    run.v.push_back(0.05 * i), run.D.push_back(3 * std::pow(0.05 * i, 0.7));
  FitOptions options;
  options.fixed[0] = 3;
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
  std::vector<Run> runs(2);
  std::vector<double> log_v, log_D;
  for (Run& run : runs) {
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
  const auto middle = newey_west({scores}, 2, residuals, each);
  CHECK(std::abs(r.sigma_b / std::sqrt((middle[0] + middle[1]) * n / (n - 2) / xx) - 1) < 1e-10);
}

TEST_CASE("loglog: with known filters the line is the same and its errors are those of the noise",
          "[fit]") {
  const Body body{1, 0.04, 0.5};
  const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.5);
  simulated::Noise noise(4);
  int covered = 0;
  double squares = 0, variances = 0, sum = 0;
  constexpr int runs = 200;
  for (int k = 0; k < runs; ++k) {
    std::vector<double> t, v;
    for (int i = 0; i < 45; ++i)
      t.push_back(0.04 * i), v.push_back(truth.v(0.04 * i) + noise(5e-4));
    const Run known = simulated::shifts(body, t, v, 11);
    Run unknown = known;
    unknown.filters.clear();
    const auto r = fit(Route::loglog, {known}, {}), plain = fit(Route::loglog, {unknown}, {});
    CHECK(r.b == plain.b);
    covered += std::abs(r.b - 0.215) < 1.96 * r.sigma_b;
    squares += (r.b - 0.215) * (r.b - 0.215);
    sum += r.b - 0.215;
    variances += r.sigma_b * r.sigma_b;
  }
  const double spread = squares - sum * sum / runs;
  CAPTURE(covered, variances / spread, sum / runs, std::sqrt(squares / runs));
  CHECK(covered >= 178);  // fewer of 95 % by chance in 0.02 %
  CHECK(std::abs(variances / spread - 1) < 0.32);
}

namespace {

FitResult line_of(const simulated::Roll& truth, const Body& body, std::size_t rows,
                  std::size_t width, double sd, simulated::Noise& noise) {
  std::vector<double> t, v;
  for (std::size_t i = 0; i < rows; ++i) {
    t.push_back(0.04 * static_cast<double>(i));
    v.push_back(truth.v(t.back()) + noise(sd));
  }
  return fit(Route::loglog, {simulated::shifts(body, t, v, width)}, {});
}

}  // namespace

TEST_CASE("loglog: the bias by known filters without noise is all of the difference", "[fit]") {
  const Body body{1, 0.04, 0.5};
  simulated::Noise noise(4);
  const auto r = line_of(simulated::roll(body, 1.87e-3, 0.215, 0.5), body, 60, 31, 1e-9, noise);
  REQUIRE(r.shares.size() == 2);
  CHECK(r.shares[1].of == "bias");
  CHECK(std::abs(r.b - 0.215) > 1e-3);
  CHECK(std::abs(r.shares[1].sigma(1) / std::abs(r.b - 0.215) - 1) < 1e-3);
  CHECK(std::abs(r.shares[1].sigma(0) / r.a / std::abs(std::log(r.a / 1.87e-3)) - 1) < 1e-3);
  CHECK(std::abs(r.sigma_b / std::abs(r.b - 0.215) - 1) < 1e-3);
}

// The noise of D takes half a standard deviation off the logarithms.
TEST_CASE("loglog: the errors allow for the bias of the logarithms of noise", "[fit]") {
  const Body body{1, 0.04, 0.5};
  const auto truth = simulated::roll(body, 5.75e-4, 0.0244, 0.5);
  simulated::Noise noise(4);
  double off = 0, squares = 0, expected = 0;
  int covered = 0, by_noise = 0;
  constexpr int runs = 300;
  for (int k = 0; k < runs; ++k) {
    const auto r = line_of(truth, body, 110, 5, 1e-2, noise);
    const double error = r.a - 5.75e-4;
    off += error / runs;
    squares += error * error / runs;
    expected -= r.shares[1].sigma(0) / runs;
    covered += std::abs(error) < 1.96 * r.sigma_a;
    by_noise += std::abs(error) < 1.96 * r.shares[0].sigma(0);
  }
  const double sd = std::sqrt(squares - off * off);
  CAPTURE(off / sd, expected / sd, covered, by_noise);
  CHECK(off < -0.4 * sd);
  CHECK(std::abs(expected - off) < 0.15 * sd);
  CHECK(covered > by_noise + 10);
}

// The second run gains speed, so that none of its D has a logarithm.
TEST_CASE("loglog: a run without a logarithm leaves the line to the others", "[fit]") {
  const Body body{1, 0.04, 0.5};
  const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.5);
  simulated::Noise noise(4);
  std::vector<double> t, slower, faster;
  for (std::size_t i = 0; i < 60; ++i) {
    t.push_back(0.04 * static_cast<double>(i));
    slower.push_back(truth.v(t.back()) + noise(1e-3));
    faster.push_back(0.3 + 0.2 * t.back());
  }
  const auto run = simulated::shifts(body, t, slower, 5);
  const auto both = fit(Route::loglog, {run, simulated::shifts(body, t, faster, 5)}, {}),
             alone = fit(Route::loglog, {run}, {});
  CHECK(both.left_out == alone.left_out + 60);
  CHECK(both.a == alone.a);
  CHECK(both.b == alone.b);
  CHECK(both.sigma_a == alone.sigma_a);
  CHECK(both.sigma_b == alone.sigma_b);
}

namespace {

/// A line of positions of the roll to 0.1 mm, which are kept up to a time and were written in a
/// unit of their own.
FitResult line_of_positions(const Body& body, double until, double unit, unsigned seed) {
  const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.45);  // it stops at 2.226 s
  simulated::Noise noise(seed);
  std::vector<double> t, x;
  for (int i = 0; 0.04 * i < until; ++i) {
    t.push_back(0.04 * i);
    x.push_back(std::round(1e4 * (0.3 + truth.x(t.back()) + noise(3e-4))) / 1e4 / unit * unit);
  }
  return fit(Route::loglog, {simulated::shifts(body, t, x, 11, "x")}, {});
}

}  // namespace

TEST_CASE("loglog: the errors of a row with a rest do not depend on the unit of x", "[fit]") {
  const Body body{1, 0.04, 0.5};
  for (const double until : {2.4, 2.8, 3.2})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const auto r = line_of_positions(body, until, 1, seed);
      for (const double unit : {0.3048, 0.0254, 1e-3}) {
        INFO("until " << until << " s, unit " << unit << " m, seed " << seed);
        const auto same = line_of_positions(body, until, unit, seed);
        CHECK(same.n == r.n);
        CHECK(std::abs(same.sigma_a / r.sigma_a - 1) < 1e-6);
        CHECK(std::abs(same.sigma_b / r.sigma_b - 1) < 1e-6);
      }
    }
}

TEST_CASE("loglog: the rows of a rest are left out and counted, and the intervals hold", "[fit]") {
  const Body body{1, 0.04, 0.5};
  constexpr int runs = 200;
  int a_held = 0, b_held = 0;
  for (unsigned seed = 1; seed <= runs; ++seed) {
    const auto r = line_of_positions(body, 3.2, 1, seed);
    CHECK(r.n <= 57);  // the roll stops after 56 rows
    CHECK(r.n + r.left_out == 80);
    a_held += std::abs(std::log(r.a / 1.87e-3)) < 1.96 * r.sigma_a / r.a;
    b_held += std::abs(r.b - 0.215) < 1.96 * r.sigma_b;
  }
  CHECK(a_held >= 178);  // fewer of 95 % by chance in 0.02 %
  CHECK(b_held >= 178);
}
