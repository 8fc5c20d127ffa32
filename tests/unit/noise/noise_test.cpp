// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/noise.h"

#include "least_squares/minimise.h"
#include "fit/refits.h"
#include "noise/response.h"
#include "unit/fit/simulated.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

constexpr std::size_t n = 40;
const std::vector<double> t = simulated::times(n);
const BandMatrix E =
    probe(simulated::differentiate(Quantity::v, Quantity::a), t) * probe(simulated::smooth_v(5), t);
const Filters filters = std::make_shared<const BandMatrix>(E);

}  // namespace

// A parabola through data behind E, so that their noise is E times white noise, with a share of
// white noise in the weights. The covariance of its coefficients is R^-1 B^T B R^-T whatever the
// weights are; the sum of squares tells the variance where the weights are those of the noise.
TEST_CASE("noise: its variance and the covariance of the parameters", "[fit]") {
  for (const double share : {0.0, 1e-3, 0.1, 1.0, 30.0}) {
    simulated::Noise random(7);
    double variances = 0, squares = 0, covariance = 0;
    constexpr int runs = 2000;
    for (int k = 0; k < runs; ++k) {
      std::vector<double> raw;
      for (const double v : t) raw.push_back(3 + 0.5 * v + 0.7 * v * v + random(2));
      ObservedRun run;
      run.column = Quantity::D, run.t = t, run.H = filters, run.y = E.times(raw);
      const auto q = Parameters({}, 1).with(laws()[3], 1, 1, {3.0});  // E takes d0 away
      Fitted fit{.minimum = {}, .model = Model(std::vector{run}, q).weighted({share})};
      fit.minimum = minimise(fit.system(), {0, 0});
      const Matrix Q = orthonormal(fit.system(), fit.minimum);
      const SeenNoise seen = seen_noise(fit, Q);
      variances += seen.variance / runs;
      squares += (fit.minimum.theta[1] - 0.7) * (fit.minimum.theta[1] - 0.7) / runs;
      if (k > 0) continue;
      const std::vector<double> B = fit.noise().to_sources(Q[1]);
      std::vector<double> slope{0, 1};
      fit.minimum.R.solve_transposed(0, slope);
      REQUIRE(B.size() == fit.noise().sources()[0]);
      for (const double of_slope : B) covariance += 4 * std::pow(of_slope * slope[1], 2);
      if (share == 0) CHECK(seen.B[1] == B);
    }
    CAPTURE(share);
    if (share == 0) CHECK(std::abs(variances / 4 - 1) < 3.3 * std::sqrt(2.0 / 10 / runs));
    CHECK(std::abs(squares / covariance - 1) < 3.3 * std::sqrt(2.0 / runs));
  }
}

TEST_CASE("noise: the least sources that explain residuals give them back", "[fit]") {
  const Noise noise({filters});
  simulated::Noise random(3);
  std::vector<double> e;
  for (std::size_t i = 0; i < n; ++i) e.push_back(random(1));
  const auto f = E.times(e);
  auto weighted = f;
  noise.whitener(0).apply(weighted);
  const auto least = noise.to_sources(weighted), explained = E.times(least);
  double size = 0, true_size = 0;
  for (std::size_t i = 0; i < n; ++i) {
    CHECK(std::abs(explained[i] - f[i]) < 1e-5);
    size += least[i] * least[i];
    true_size += e[i] * e[i];
  }
  CHECK(size <= true_size);
  std::vector<std::size_t> runs;
  const auto innovations = noise.innovations(weighted, runs);
  REQUIRE(runs.size() == 1);
  CHECK(innovations.size() == runs[0]);
  CHECK(runs[0] < n);  // differences know nothing of a constant
}

// The ranks are those of the singular values of these matrices.
TEST_CASE("noise: as many innovations as the filters leave degrees of freedom", "[noise]") {
  const auto innovations = [](std::size_t rows, std::size_t width) {
    const std::vector<double> at = simulated::times(rows);
    const auto H = std::make_shared<const BandMatrix>(
        probe(simulated::smooth_v(width), at) *
        probe(simulated::differentiate(Quantity::x, Quantity::v), at));
    return Noise({H, H}).informative();
  };
  CHECK(innovations(7, 3) == 2 * 5);
  CHECK(innovations(8, 3) == 2 * 7);
  CHECK(innovations(10, 11) == 2 * 6);
  CHECK(innovations(12, 11) == 2 * 7);
  CHECK(innovations(14, 11) == 2 * 10);
}
