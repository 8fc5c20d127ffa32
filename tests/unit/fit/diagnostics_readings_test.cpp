// SPDX-License-Identifier: GPL-3.0-or-later
// Readings that are off, what they do to the search for a period, and the rounding of readings.
#include "base/error.h"
#include "fit/fit.h"
#include "unit/catch.h"
#include "unit/fit/rolls.h"
#include "unit/many.h"

using namespace rolls;

namespace {

Run roll_of(unsigned seed, PowerLaw law = rubber) {
  simulated::Noise noise(seed);
  return roll(law, 0, 1, noise);
}

FitResult fitted(const Run& run, bool robust = false) {
  FitOptions options;
  options.robust = robust;
  return fit(Route::position, {run}, options);
}

}  // namespace

TEST_CASE("a zero, a spike and a burst are named with their time", "[many]") {
  const unsigned runs = of_many(40);
  for (unsigned seed = 0; seed < runs; ++seed) {
    const Run good = roll_of(seed, seed % 2 ? rubber : felt);
    CHECK(fitted(good).off.count == 0);
    const std::size_t n = good.t.size(), at = 2 + seed * (n - 6) / runs;
    for (const std::size_t burst : {1U, 3U}) {
      Run run = good;
      for (std::size_t i = at; i < at + burst; ++i) run.x[i] += 0.006;  // 20 times the noise
      const auto off = fitted(run).off;
      INFO(seed << ", " << burst << " from " << at << " of " << n);
      CHECK(off.count == burst);
      CHECK(off.time >= run.t[at]);
      CHECK(off.time <= run.t[at + burst - 1]);
      CHECK(off.distance > 10);
      CHECK(fitted(run, true).off.count == 0);
    }
  }
}

// The first and the last reading of a short run bend the roll to themselves.
TEST_CASE("a reading that is off at an end of twenty is named", "[many]") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Run all = roll_of(seed);
    Run good = all;
    good.t.clear(), good.x.clear();
    for (std::size_t i = 0; i < 20; ++i) {
      const std::size_t k = i * (all.t.size() - 1) / 19;
      good.t.push_back(all.t[k]), good.x.push_back(all.x[k]);
    }
    CHECK(fitted(good).off.count == 0);
    for (const std::size_t at : {0U, 1U, 18U, 19U}) {
      Run run = good;
      run.x[at] += 0.012;  // 40 times the noise
      const auto off = fitted(run).off;
      INFO(seed << ", " << at);
      CHECK(off.count == 1);
      CHECK(off.time == run.t[at]);
    }
  }
}

// A reading far behind the others has a leverage near 1. The square of its distance is the F ratio
// of the sums of squares with it and without it, which the fits of both show: as long as the roll
// is nearly linear in its numbers.
TEST_CASE("the distance of a single reading is that of Student's t, whatever its leverage") {
  const Run all = roll_of(4);
  Run few = all;
  constexpr std::size_t n = 30;
  few.t.resize(n), few.x.resize(n);
  const double freedom = n - 4, without = std::pow(fitted(few).rms, 2) * freedom;
  for (const auto& [at, off] : {std::pair(n, 0.006), {n, 0.01}, {33, 0.006}, {36, 0.006}}) {
    Run run = few;
    run.t.push_back(all.t.at(at)), run.x.push_back(all.x.at(at) + off);
    const FitResult with = fitted(run);
    const double F = (std::pow(with.rms, 2) * (freedom + 1) - without) / without * freedom;
    CAPTURE(at, off, F, with.off.distance, with.b);
    CHECK(std::abs(with.off.distance / std::sqrt(F) - 1) < 0.05);
    CHECK(with.off.count == (F > 100));
  }
}

TEST_CASE("a spike in positions is found behind differences and means") {
  const Run raw = roll_of(3, felt);
  std::vector<double> x = raw.x;
  x[70] += 0.006;
  const Run run = simulated::shifts(cylinder, raw.t, x, 5, "x");
  const auto off = fit(Route::shift, {run}, {}).off;
  REQUIRE(off.count > 0);
  CHECK(off.time == Approx(raw.t[70]));
  CHECK(fit(Route::shift, {simulated::shifts(cylinder, raw.t, raw.x, 5, "x")}, {}).off.count == 0);
}

TEST_CASE("bursts and lost echoes are no eccentricity", "[many]") {
  const unsigned runs = of_many(60);
  unsigned told = 0;
  for (unsigned seed = 0; seed < runs; ++seed) {
    Run run = roll_of(seed, felt);
    for (const std::size_t at : {9U, 40U, 77U, 110U}) run.x[at + seed % 7] = 0;
    told += fitted(run).eccentricity.has_value();
  }
  CHECK(told <= at_most(runs, 0.01));
}

TEST_CASE("no standard uncertainty is below what the rounding of the readings leaves", "[many]") {
  // Four of six readings at rest leave no noise: b is -0.14, but nobody knows.
  Run run{};
  run.body = {1, 0.0125, 0.03};
  run.t = {0, .05, .1, .15, .2, .25};
  run.x = {2.906, 2.914, 2.917, 2.917, 2.917, 2.917};
  std::string message;
  try {
    fitted(run);
  } catch (const Error& error) {
    message = error.what();
  }
  CHECK(message.find("do not determine b") < message.size());
  double squares = 0;
  int fits = 0;
  for (int phase = 0; phase < 100; ++phase) {
    Run rounded{};
    rounded.body = cylinder;
    const auto truth = simulated::roll(cylinder, felt.a, felt.b, 0.5);
    for (int i = 0; i < 12; ++i) {
      rounded.t.push_back(0.4 * i);
      rounded.x.push_back(std::round((truth.x(rounded.t.back()) + 1e-5 * phase) / 1e-3) * 1e-3);
    }
    const FitResult found = fitted(rounded);
    squares += std::pow((found.b - felt.b) / found.sigma_b, 2), ++fits;
  }
  CHECK(squares / fits < 1.3);
}

TEST_CASE("the floor of rounding holds where no reading repeats, but not for gates") {
  const auto truth = simulated::roll(cylinder, felt.a, felt.b, 0.5);
  const auto sigma = [&](double off) {  // positions on a grid of 1 mm, met to this part of it
    Run run{};
    run.body = cylinder;
    for (int i = 1; i <= 12; ++i) {
      const double x = 1e-3 * (100 * i + 37 * i % 10), part = off * 1e-3 * (i % 2 ? 1 : -1);
      double t = 0.3 * i;
      for (int step = 0; step < 50; ++step) t += (x + part - truth.x(t)) / truth.v(t);
      run.t.push_back(t), run.x.push_back(x);
    }
    return fitted(run).sigma_b;
  };
  // Rounding leaves 0.29 of a step: residuals of 0.2 do not speak against it, and have its errors.
  const double rounded = sigma(0.2);
  CHECK(std::abs(sigma(0.25) / rounded - 1) < 0.03);  // b itself is not the same
  CHECK(sigma(0.02) < 0.1 * rounded);
  // Residuals of 0.4 have errors of their own size: 12 of them, of which 4 parameters take a third
  // of the freedom, have a variance of 0.16 12/8; that of rounding is 1/12.
  CHECK(std::abs(sigma(0.4) / rounded / std::sqrt(0.16 * 12 / 8 * 12) - 1) < 0.05);
}

// x = n q (2 N - n) lies on the grid q, or a coarser one, and on a parabola, the roll for b = 0:
// the residuals are rounding errors of the program, and would be those of the readings at other
// phases.
TEST_CASE("readings of a clock that meet a roll by chance have the floor of rounding, too") {
  for (const std::size_t rows : {5u, 6u, 8u, 12u, 40u})
    for (const double q : {1e-4, 1e-3, 1e-2})
      for (const int lost : {0, 1, 2}) {  // the last but one, or from the third on every second
        if (lost == 2 && rows < 8) continue;
        Run run{};
        run.body = cylinder;
        for (std::size_t i = 0; i < rows; ++i) {
          if ((lost == 1 && i == rows - 2) || (lost == 2 && i > 1 && i % 2 == 0)) continue;
          run.t.push_back(5 + 0.2 * static_cast<double>(i));
          run.x.push_back(q * static_cast<double>(i * (2 * rows - i)));
        }
        FitOptions options;
        options.fixed[1] = 0;
        const FitResult found = fit(Route::position, {run}, options);
        // of v' = -g a/((K + 1) R) over the run: rounding of one reading shifts it by so much
        const double time = run.t.back() - run.t.front(),
                     a = q / std::sqrt(12) / (time * time) * 1.5 * 0.04 / 9.81;
        CAPTURE(rows, q, found.a, found.sigma_a);
        CHECK(found.sigma_a > a);
        CHECK(!(compare_laws(Route::position, {run}, {}).against >= levels::another_law));
      }
}

TEST_CASE("a v0 that no reading comes near is refused") {
  for (const double off : {0.005, 0.02, 0.1, 0.5, 3.0})
    for (const PowerLaw law : {rubber, felt}) {
      Run run = roll_of(1, law);
      run.x.front() -= off;
      CHECK(std::abs(fitted(run, true).v0[0].value - 0.5) < 0.01);
      try {
        const FitResult r = fitted(run);
        CAPTURE(off, r.a, r.b);
        CHECK(r.v0[0].value < 5);
        CHECK((r.off.count > 0 || !(off < 0.1)));
      } catch (const Error&) {  // refused
      }
    }
}
