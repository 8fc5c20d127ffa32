// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/fit.h"
#include "unit/catch.h"
#include "unit/fit/simulated.h"

#include <array>
#include <cmath>

using namespace rolling;

namespace {

const Body body{1, 0.04, 0.5};
constexpr double v = 0.5, e = 40e-6, phase = 0.7;

constexpr double k = 9.81 / (1.5 * 0.04);  // g/((K + 1) R)

double smooth(double t) { return v * t - k * 2e-6 / 2 * t * t; }

/// A body of all but steady speed, whose weight turns it by e once a turn: to first order its x has
/// k e (R/v)^2 cos(x/R - phase) more.
Run wobbling(double size, double noise, double end = 4, double step = 0.03) {
  Run run{};
  run.body = body;
  simulated::Noise random(5);
  const double amplitude = k * size * std::pow(body.R / v, 2);
  for (double t = 0; t < end; t += step) {
    run.t.push_back(t);
    run.x.push_back(smooth(t) + amplitude * std::cos(smooth(t) / body.R - phase) + random(noise));
  }
  return run;
}

/// Least squares of x on 1, t, t^2, cos and sin of x/R, the periodogram at one period, by Gauss and
/// Jordan's elimination in the normal equations.
struct Harmonic {
  double size, phase, sigma, p;
};
Harmonic harmonic(const Run& run) {
  constexpr std::size_t p = 5;
  double A[p][2 * p + 1] = {};  // the normal matrix, the right-hand side, and the unit matrix
  const auto row = [&](std::size_t i) {
    const double t = run.t[i], angle = smooth(t) / body.R;
    return std::array{1., t, t * t, std::cos(angle), std::sin(angle), run.x[i]};
  };
  for (std::size_t j = 0; j < p; ++j) A[j][p + 1 + j] = 1;
  for (std::size_t i = 0; i < run.t.size(); ++i)
    for (std::size_t j = 0; j < p; ++j)
      for (std::size_t l = 0; l <= p; ++l) A[j][l] += row(i)[j] * row(i)[l];
  double squares_of_three = 0;  // the residual sum of squares of the first three columns alone
  const auto squares = [&](std::size_t columns) {
    double sum = 0;
    for (std::size_t i = 0; i < run.t.size(); ++i) {
      double f = -row(i)[p];
      for (std::size_t j = 0; j < columns; ++j) f += row(i)[j] * A[j][p] / A[j][j];
      sum += f * f;
    }
    return sum;
  };
  for (std::size_t j = 0; j < p; ++j) {
    if (j == 3) squares_of_three = squares(3);
    for (std::size_t i = 0; i < p; ++i) {
      const double factor = A[i][j] / A[j][j];
      for (std::size_t l = 0; i != j && l <= 2 * p; ++l) A[i][l] -= factor * A[j][l];
    }
  }
  const double freedom = static_cast<double>(run.t.size() - p), variance = squares(p) / freedom,
               by_cos = A[3][p] / A[3][3], by_sin = A[4][p] / A[4][4],
               size = std::hypot(by_cos, by_sin), c = by_cos / size, s = by_sin / size,
               F = (squares_of_three / variance - freedom) / 2;
  const auto inverse = [&](std::size_t i, std::size_t j) { return A[i][p + 1 + j] / A[i][i]; };
  // For two numerator degrees of freedom the distribution of F has a closed form.
  return {size, std::atan2(by_sin, by_cos),
          std::sqrt(variance *
                    (c * c * inverse(3, 3) + 2 * c * s * inverse(3, 4) + s * s * inverse(4, 4))),
          std::pow(1 + 2 * F / freedom, -freedom / 2)};
}

FitResult fitted(const Run& run) {
  FitOptions options;
  options.fixed[1] = 0;
  return fit(Route::position, {run}, options);
}

}  // namespace

TEST_CASE("eccentricity: at a steady speed it is the periodogram over time", "[fit]") {
  const Run run = wobbling(e, 1e-5, 1.2);
  const auto found = fitted(run).eccentricity;
  REQUIRE(found);
  const Harmonic by_hand = harmonic(run);
  const double unit = k * std::pow(body.R / v, 2);
  CHECK(found->e == Approx(by_hand.size / unit).epsilon(0.003));
  CHECK(found->phase == Approx(by_hand.phase).margin(0.003));
  CHECK(found->sigma == Approx(by_hand.sigma / unit).epsilon(0.003));
  CHECK(std::log(found->p) == Approx(std::log(by_hand.p)).epsilon(0.003));
  CHECK(std::abs(found->e - e) < 4 * found->sigma);
}

TEST_CASE("eccentricity: shifts made of the positions tell what the positions tell", "[fit]") {
  const Run run = wobbling(e, 1e-5);
  FitOptions options;
  options.fixed[1] = 0;
  const auto by_x = fitted(run).eccentricity,
             by_D = fit(Route::shift, {simulated::shifts(body, run.t, run.x, 5, "x")}, options)
                        .eccentricity;
  REQUIRE((by_x && by_D));
  CHECK(by_D->e == Approx(by_x->e).epsilon(0.02));
  CHECK(by_D->phase == Approx(by_x->phase).margin(0.02));
  CHECK(by_D->sigma == Approx(by_x->sigma).epsilon(0.05));
}

TEST_CASE("eccentricity: of another period, or none, it is not said", "[fit]") {
  CHECK_FALSE(fitted(wobbling(0, 1e-5)).eccentricity);
  Run other = wobbling(e, 1e-5);
  other.body.R *= 1.4;
  CHECK_FALSE(fitted(other).eccentricity);
}

// Of thirds with 1 + d, 1 and 1 - d times the signal the squares differ by 2/3 d^2 of what they
// have in common. Noise hides that, unless a third has no signal at all.
TEST_CASE("eccentricity: a body is out of balance all along its roll", "[fit]") {
  for (const double noise : {1e-6, 5e-5}) {
    const Run none = wobbling(0, noise);
    const Run whole = wobbling(e, noise);
    for (const double d : {0., 0.3, 0.5, 1.}) {
      Run run = whole;
      for (std::size_t i = 0; i < run.t.size(); ++i) {
        const double third = std::floor(3 * run.x[i] / run.x.back());
        run.x[i] = none.x[i] + (1 + d * (1 - std::min(third, 2.))) * (whole.x[i] - none.x[i]);
      }
      CAPTURE(noise, d);
      CHECK(fitted(run).eccentricity.has_value() == (d < (noise < 1e-5 ? 0.4 : 0.9)));
    }
  }
}

TEST_CASE("eccentricity: the run of several that has it is named; less than a turn tells nothing",
          "[fit]") {
  const Run good = wobbling(0, 1e-5), bad = wobbling(e, 1e-5);
  FitOptions options;
  options.fixed[1] = 0;
  const auto found = fit(Route::position, {good, bad, good}, options).eccentricity;
  REQUIRE(found);
  CHECK(found->run == 1);
  Run brief = bad;
  brief.t.resize(10), brief.x.resize(10);
  CHECK_FALSE(fitted(brief).eccentricity);
}

// Of 200 with a chance of 1 %, 9 or more come in 1 of 4000.
TEST_CASE("eccentricity: the noise of each run is its own", "[fit]") {
  FitOptions options;
  options.fixed[1] = 0;
  const Run quiet = wobbling(0, 1e-6);
  simulated::Noise noise(10);
  int found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Run loud = quiet;
    for (double& x : loud.x) x += noise(1e-5);
    found += fit(Route::position, {quiet, quiet, quiet, quiet, quiet, loud}, options)
                 .eccentricity.has_value();
  }
  CHECK(found <= 8);
}

TEST_CASE("eccentricity: it takes 30 rows", "[fit]") {
  for (const std::size_t rows : {29u, 30u}) {
    Run run = wobbling(e, 1e-6, 12, 0.2);
    run.t.resize(rows), run.x.resize(rows);
    CHECK(fitted(run).eccentricity.has_value() == (rows == 30));
  }
}

TEST_CASE("eccentricity: it takes more than one row in each half turn", "[fit]") {
  // A half turn takes pi R/v = 0.25 s.
  CHECK(fitted(wobbling(e, 1e-6, 12, 0.24)).eccentricity);
  CHECK_FALSE(fitted(wobbling(e, 1e-6, 12, 0.27)).eccentricity);
}
