// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/fit.h"

#include "base/error.h"
#include "motion/roll.h"
#include "unit/fit/simulated.h"
#include "unit/catch.h"

#include <algorithm>
#include <limits>
#include <string>

using namespace rolling;

namespace {

const Body unit{1, 1, 0, 1};  // g/((K + 1) R) = 1: D is the deceleration

enum Made { power, constant, linear, quadratic };
constexpr std::size_t number[] = {0, 1, 2, 4};  // of these in laws()

/// Rolls to the stop under D = 0.2 sqrt(v); 0.1; 0.1 + 0.2 v; 0.1 + 0.4 v^2, all from v0 = 1, by
/// hand.
Run roll(Made law, Route route, double size) {
  Run run{};
  run.body = unit;
  simulated::Noise noise(31);
  for (double t = 0; t < 12; t += 0.05) {
    double v = 0, x = 0;
    if (law == power) v = std::pow(1 - 0.1 * t, 2), x = (1 - std::pow(1 - 0.1 * t, 3)) / 0.3;
    if (law == constant) v = 1 - 0.1 * t, x = t - 0.05 * t * t;
    if (law == linear)
      v = 1.5 * std::exp(-0.2 * t) - 0.5, x = 7.5 * (1 - std::exp(-0.2 * t)) - 0.5 * t;
    if (law == quadratic)
      v = 0.5 * std::tan(std::atan(2) - 0.2 * t),
      x = 2.5 * std::log(std::cos(std::atan(2) - 0.2 * t) / std::cos(std::atan(2)));
    if (v <= 0 || (law == power && t > 10)) break;
    run.t.push_back(t);
    run.v.push_back(v + (route == Route::velocity ? noise(size) : 0));
    run.x.push_back(x + noise(size));
    run.D.push_back((law == power      ? 0.2 * std::sqrt(v)
                     : law == constant ? 0.1
                     : law == linear   ? 0.1 + 0.2 * v
                                       : 0.1 + 0.4 * v * v) +
                    noise(size / 10));
  }
  return run;
}

/// AICc of the best law.
double least_of(const LawComparison& comparison) {
  return std::ranges::min(comparison.fits, {}, &LawFit::aicc).aicc;
}

}  // namespace

// Of 120 intervals, fewer than .883 or more than .992 hold in one of a thousand where .95 should.
TEST_CASE("laws: the intervals of another law that is fitted hold it, whichever the route",
          "[fit]") {
  for (const Route route : {Route::velocity, Route::position}) {
    FitOptions options;
    options.law = &laws()[number[quadratic]];
    const Run clean = roll(quadratic, route, 0);
    simulated::Noise noise(7);
    const std::vector<double> truth{0.1, 0.4};
    std::vector<int> held(2);
    double corr = 0;
    constexpr int runs = 120;
    for (int i = 0; i < runs; ++i) {
      Run run = clean;
      for (double& x : route == Route::velocity ? run.v : run.x) x += noise(1e-3);
      const FitResult r = fit(route, {run}, options);
      REQUIRE(r.coefficients.size() == 2);
      CHECK(std::isnan(r.a));
      for (std::size_t j = 0; j < 2; ++j)
        held[j] += std::abs(r.coefficients[j].value - truth[j]) < 1.96 * r.coefficients[j].sigma;
      corr += r.correlations[0][1] / runs;
    }
    for (std::size_t j = 0; j < 2; ++j) {
      CAPTURE(static_cast<int>(route), j);
      CHECK(held[j] >= 106);
      CHECK(held[j] <= 119);
    }
    CHECK(corr < -0.8);
  }
}

TEST_CASE("laws: a joint fit of another law is the mean of runs that agree", "[fit]") {
  FitOptions options;
  options.law = &laws()[number[quadratic]];
  const Run clean = roll(quadratic, Route::position, 0);
  simulated::Noise noise(8);
  std::vector<Run> runs(3, clean);
  double mean = 0, sigma = 0;
  for (Run& run : runs) {
    for (double& x : run.x) x += noise(1e-3);
    const FitResult own = fit(Route::position, {run}, options);
    mean += own.coefficients[1].value / 3, sigma += own.coefficients[1].sigma / 3;
  }
  const FitResult joint = fit(Route::position, runs, options);
  REQUIRE(joint.agreement);
  CHECK(joint.agreement->agree());
  CHECK(joint.agreement->dof == 4);
  CHECK(std::abs(joint.coefficients[1].value - mean) < 0.1 * joint.coefficients[1].sigma);
  CHECK(joint.coefficients[1].sigma == Approx(sigma / std::sqrt(3)).epsilon(0.1));
  for (double& x : runs[1].x) x *= 0.98;  // as of a body that slows down otherwise
  const FitResult apart = fit(Route::position, runs, options);
  CHECK(!apart.agreement->agree());
  CHECK(apart.agreement->run == 1);
  CHECK(apart.coefficients[1].sigma > 3 * joint.coefficients[1].sigma);
}

TEST_CASE("laws: on every route the law that made the row is not beaten, and lesser laws are",
          "[fit]") {
  for (Route route : {Route::loglog, Route::shift, Route::velocity, Route::position})
    for (Made law : {power, constant, linear, quadratic}) {
      const auto result = compare_laws(route, {roll(law, route, 1e-3)}, {});
      const auto aicc = [&](Made of) { return result.fits[number[of]].aicc; };
      CAPTURE(static_cast<int>(route), static_cast<int>(law));
      REQUIRE(result.fits.size() == laws().size());
      // An unneeded coefficient wins by more than 2 in one of twenty.
      CHECK(aicc(law) < least_of(result) + 4);
      if (law != constant) CHECK(aicc(constant) > least_of(result) + 100);
      if (law == quadratic) CHECK(aicc(linear) > least_of(result) + 10);
      if (law == linear || law == quadratic) {
        CHECK(aicc(power) > least_of(result) + 10);
        CHECK(result.against > 10);
      }
      if (law == power) {
        CHECK(aicc(linear) > least_of(result) + 10);
        CHECK(result.against < 4);
      }
      const std::vector<double> truth = law == power      ? std::vector{0.2, 0.5}
                                        : law == constant ? std::vector{0.1}
                                        : law == linear   ? std::vector{0.1, 0.2}
                                                          : std::vector{0.1, 0.4};
      const LawFit& own = result.fits[number[law]];
      REQUIRE(own.coefficients.size() == truth.size());
      // loglog is biased by the noise of D.
      for (std::size_t j = 0; j < truth.size(); ++j)
        CHECK(std::abs(own.coefficients[j].value - truth[j]) < 4 * own.coefficients[j].sigma);
    }
}

TEST_CASE("laws: coefficients are those of linear least squares, with its errors", "[fit]") {
  Run run{};
  simulated::Noise noise(8);
  for (int i = 1; i <= 25; ++i)
    run.v.push_back(0.2 * i), run.D.push_back(1 + 0.5 * run.v.back() + noise(0.05));
  const auto line = compare_laws(Route::shift, {run}, {}).fits[2];
  // The textbook's straight line.
  double n = 25, Sv = 0, SD = 0, Svv = 0, SvD = 0;
  for (std::size_t i = 0; i < 25; ++i)
    Sv += run.v[i], SD += run.D[i], Svv += run.v[i] * run.v[i], SvD += run.v[i] * run.D[i];
  const double det = n * Svv - Sv * Sv, d1 = (n * SvD - Sv * SD) / det, d0 = (SD - d1 * Sv) / n;
  double rss = 0;
  for (std::size_t i = 0; i < 25; ++i) rss += std::pow(run.D[i] - d0 - d1 * run.v[i], 2);
  const double s2 = rss / (n - 2);
  CHECK(line.coefficients[0].value == Approx(d0));
  CHECK(line.coefficients[1].value == Approx(d1));
  CHECK(line.coefficients[0].sigma == Approx(std::sqrt(s2 * Svv / det)));
  CHECK(line.coefficients[1].sigma == Approx(std::sqrt(s2 * n / det)));
  CHECK(line.correlations[0][1] == Approx(-Sv / std::sqrt(n * Svv)));
  CHECK(line.correlations[0][0] == Approx(1));
}

TEST_CASE("laws: the row's a and b are those of the comparison; a slope is fitted for every law",
          "[fit]") {
  Run there = roll(linear, Route::position, 1e-4), back = there;
  for (double& x : back.x) x = -x;
  const auto r = fit(Route::position, {there, back}, {});
  const auto same = compare_laws(Route::position, {there, back}, {}).fits[0];
  CHECK(same.coefficients[0].value == r.a);
  CHECK(same.coefficients[1].sigma == r.sigma_b);
  CHECK(same.correlations[0][1] == Approx(r.corr));
  FitOptions options;
  options.fit_slope = true;
  const auto result = compare_laws(Route::position, {there, back}, options);
  CHECK(result.against > 10);
  CHECK(std::abs(result.fits[2].coefficients[1].value - 0.2) <
        4 * result.fits[2].coefficients[1].sigma);
}

TEST_CASE("laws: a law that the rows cannot determine is not among those that win", "[fit]") {
  Run run{};
  run.body = unit;
  simulated::Noise noise(3);
  for (int i = 0; i < 20; ++i)
    run.v.push_back(i % 2 ? 1 : 2), run.D.push_back(run.v.back() + noise(0.01));
  // Two speeds: a line through them, and no parabola.
  const auto result = compare_laws(Route::shift, {run}, {});
  CHECK(std::isfinite(result.fits[2].aicc));
  CHECK(result.fits[3].aicc == std::numeric_limits<double>::infinity());
  CHECK(result.fits[3].coefficients.empty());
}

TEST_CASE("laws: what is held stays held, and a robust comparison is refused", "[fit]") {
  Run run = roll(linear, Route::velocity, 1e-3);
  FitOptions options;
  options.v0 = 0.7;  // a wrong one: no law can mend it
  const auto held = compare_laws(Route::velocity, {run}, options),
             free = compare_laws(Route::velocity, {run}, {});
  CHECK(held.fits[2].aicc > free.fits[2].aicc + 100);
  options = {};
  options.robust = true;
  CHECK_THROWS_AS(compare_laws(Route::velocity, {run}, options), Error);
}

TEST_CASE("laws: rows with correlated noise count as the fewer that they are", "[fit]") {
  // A constant D with AR(1) noise: its slow part looks like other laws. Counted as 400 independent
  // rows nearly every run would show one of them to be better, by far.
  int wrong = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    simulated::Noise noise(seed);
    Run run{};
    double e = 0;
    for (int i = 0; i < 400; ++i) {
      e = 0.8 * e + noise(0.002);
      run.v.push_back(1 - 0.002 * i);
      run.D.push_back(0.1 + e);
    }
    const auto result = compare_laws(Route::shift, {run}, {});
    wrong += result.fits[number[constant]].aicc > least_of(result) + 4;
  }
  CHECK(wrong <= 6);
}

TEST_CASE("laws: of many rows, which are compared by their means, all count", "[fit]") {
  // Under a constant D the place is a parabola: the textbook's least squares, u^2 less its mean
  // being orthogonal to 1 and u.
  constexpr int half = 10000;
  constexpr double h = 5e-4;
  Run run{};
  run.body = unit;
  simulated::Noise noise(17);
  double mean = 0, along = 0, squares = 0, rss = 0;
  for (int i = -half; i <= half; ++i) {
    const double t = h * (i + half);
    run.t.push_back(t), run.x.push_back(t - 0.05 * t * t + noise(1e-3));
    mean += static_cast<double>(i) * i / (2 * half + 1);
  }
  double x_mean = 0, slope = 0, uu = 0;
  const auto each = [&](auto what) {
    for (int i = -half; i <= half; ++i)
      what(static_cast<double>(i), run.x[static_cast<std::size_t>(i + half)]);
  };
  each([&](double u, double x) {
    x_mean += x / (2 * half + 1), slope += u * x, uu += u * u;
    along += (u * u - mean) * x, squares += (u * u - mean) * (u * u - mean);
  });
  each([&](double u, double x) {
    rss += std::pow(x - x_mean - slope / uu * u - along / squares * (u * u - mean), 2);
  });
  const auto result = compare_laws(Route::position, {run}, {});
  const LawFit& constant_D = result.fits[number[constant]];
  const double sigma = 2 * std::sqrt(rss / (2 * half - 2) / squares) / (h * h);
  // One row stands alone in the last block and counts as five.
  CHECK(std::abs(constant_D.coefficients[0].value + 2 * along / squares / (h * h)) < 0.1 * sigma);
  CHECK(constant_D.coefficients[0].sigma == Approx(sigma).epsilon(0.03));  // 1 in sqrt(8000)
  CHECK(constant_D.aicc < least_of(result) + 4);
}

// Filters lose nothing but v0 and x0: see rolling-fits(7).
TEST_CASE("laws: through known filters the coefficients are as precise as those of the positions",
          "[fit]") {
  for (Made law : {linear, quadratic}) {
    Run raw = roll(law, Route::position, 1e-3),
        filtered = simulated::shifts(unit, raw.t, raw.x, 5, "x");
    filtered.body = unit;
    const LawFit by_x = compare_laws(Route::position, {raw}, {}).fits[number[law]],
                 by_D = compare_laws(Route::shift, {filtered}, {}).fits[number[law]];
    const std::vector<double> truth = law == linear ? std::vector{0.1, 0.2} : std::vector{0.1, 0.4};
    for (std::size_t j = 0; j < 2; ++j) {
      const auto [value, sigma] = by_D.coefficients[j];
      CAPTURE(j, value, sigma);
      CHECK(std::abs(value - truth[j]) < 3 * sigma);
      CHECK(std::abs(value - by_x.coefficients[j].value) < sigma);
      CHECK(sigma / by_x.coefficients[j].sigma == Approx(1).epsilon(0.1));
    }
  }
}

// A mean over 7 of 8 rows has rank 5: the covariance of the smoothed speeds is singular.
TEST_CASE("laws: singular noise gives no negative variance, and no correlation above 1", "[fit]") {
  const Body body{1.375, 0.04, 0.5};
  constexpr std::size_t n = 8, width = 7;
  int fitted = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const auto truth = simulated::roll(body, 1e-3, 0.2, 0.3 + 0.01 * seed);
    const double time = std::pow(truth.v0, 0.8) / (0.8 * truth.a * truth.c);
    simulated::Noise noise(seed);
    Run run{};
    run.body = body;
    for (std::size_t i = 0; i < n; ++i) {
      run.t.push_back((0.5 + 0.02 * seed) * time * static_cast<double>(i) / (n - 1));
      run.v.push_back(truth.v(run.t.back()) + noise(1e-3));
    }
    run.filters = {simulated::smooth_v(width)};
    run.v = simulated::mean(run.v, width);
    LawComparison found;
    try {
      found = compare_laws(Route::velocity, {run}, {});
    } catch (const Error&) {  // the rows do not determine a law
      continue;
    }
    ++fitted;
    for (const LawFit& law : found.fits) {
      CAPTURE(seed, law.law->formula);
      for (const Estimate& c : law.coefficients) CHECK(!std::isnan(c.sigma));
      for (const auto& row : law.correlations)
        for (const double corr : row) CHECK(std::abs(corr) < 1 + 1e-9);
    }
  }
  CHECK(fitted > 30);
}

// Where the sum of squares is quadratic, a coefficient that is fixed at its value leaves the others
// as they were, with the conditional covariance C_kk - C_kj^2/C_jj.
TEST_CASE("laws: any coefficient can be fixed", "[fit]") {
  const std::vector<double> truths[] = {
      {}, {}, {0.1, 0.2}, {0.1, 0.1, 0.2}, {0.1, 0.4}, {0.1, 0.3, 0.7}, {0.1, 0.2, 0.3}};
  for (std::size_t law = 2; law < laws().size(); ++law) {
    FitOptions options;
    options.law = &laws()[law];
    Roll truth(unit, Law(laws()[law], truths[law]), 1);
    simulated::Noise noise(5);
    Run run{};
    run.body = unit;
    for (double t = 0; t < truth.stop_time(); t += 0.02) {
      run.t.push_back(t);
      run.x.push_back(truth.at(t).x + noise(1e-5));
    }
    const FitResult free = fit(Route::position, {run}, options);
    REQUIRE(free.errors == Errors::classical);
    for (std::size_t j = 0; j < truths[law].size(); ++j) {
      FitOptions held = options;
      held.fixed[j] = free.coefficients[j].value;
      const FitResult r = fit(Route::position, {run}, held);
      const double freedom = static_cast<double>(free.freedom);
      for (std::size_t k = 0; k < truths[law].size(); ++k) {
        CAPTURE(laws()[law].formula, j, k);
        const double sigma = free.coefficients[k].sigma;
        CHECK(std::abs(r.coefficients[k].value - free.coefficients[k].value) < 1e-4 * sigma);
        if (k == j) {
          CHECK(r.coefficients[k].sigma == 0);
          continue;
        }
        const double corr = free.correlations[std::max(j, k)][std::min(j, k)];
        const double conditional = sigma * std::sqrt((1 - corr * corr) * freedom / (freedom + 1));
        CHECK(r.coefficients[k].sigma == Approx(conditional).epsilon(1e-3));
      }
    }
  }
}
