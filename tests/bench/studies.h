// SPDX-License-Identifier: GPL-3.0-or-later
// Do the answers of a joint fit hold: whether runs agree, the slope of the mat, what the given
// numbers bring to the errors, and rows that --min-speed leaves out? Simulated rolls, fitted
// again and again. `make coverage` prints them; tests of tests/unit/fit take short forms.
#pragma once

#include "bench/troubles.h"
#include "motion/roll.h"
#include "unit/fit/rolls.h"

namespace studies {

using namespace rolling;

constexpr PowerLaw CR = rolls::rubber, CF = rolls::felt;

/// Of estimates with a standard error, and their truth.
struct Tally {
  double truth;
  double sum = 0, squares = 0, of_sigma = 0;
  int n = 0, covered = 0;

  void add(double value, double sigma) {
    const double off = value - truth;
    sum += off;
    squares += off * off;
    of_sigma += sigma * sigma;
    covered += std::abs(off) < 1.96 * sigma;
    ++n;
  }
  double bias() const { return sum / n; }
  double sd() const { return std::sqrt((squares - sum * sum / n) / (n - 1)); }
  double sigma() const { return std::sqrt(of_sigma / n); }  ///< root of the mean square
  double cover() const { return static_cast<double>(covered) / n; }
};

/// How many of `sets` joint fits of so many rolls are said to disagree; with a slope every second
/// roll goes the other way.
inline int disagreements(PowerLaw law, int rolls, double slope, int sets, unsigned seed) {
  simulated::Noise noise(seed);
  int all = 0;
  for (int k = 0; k < sets; ++k) {
    std::vector<Run> runs;
    for (int i = 0; i < rolls; ++i)
      runs.push_back(rolls::roll(law, slope, slope != 0 && i % 2 ? -1 : 1, noise));
    all += !fit(Route::position, runs, {}).agreement->agree();
  }
  return all;
}

/// Pairs of rolls up and down, with the slope as a parameter: a, b, slope.
struct SlopePairs {
  Tally a, b, slope;
};
inline SlopePairs slope_pairs(PowerLaw law, double slope, int pairs, unsigned seed) {
  simulated::Noise noise(seed);
  SlopePairs all{{law.a}, {law.b}, {slope}};
  FitOptions options;
  options.fit_slope = true;
  for (int k = 0; k < pairs; ++k) {
    const std::vector<Run> runs{rolls::roll(law, slope, 1, noise),
                                rolls::roll(law, slope, -1, noise)};
    const FitResult r = fit(Route::position, runs, options);
    all.a.add(r.a, r.sigma_a);
    all.b.add(r.b, r.sigma_b);
    all.slope.add(r.scene[0]->value, r.scene[0]->sigma);
  }
  return all;
}

/// Runs of a sonar up a slope, over the turning point and back at 25 Hz, towards growing and
/// falling x in turn, with the slope as a parameter.
struct Turning {
  const char* name;
  double K, R;
  PowerLaw law;
};
constexpr Turning turning[] = {{"ball", 0.4, 0.0127, {5e-5, 0.1}},
                               {"cart", 0.05, 0.02, {2e-4, 0.3}},
                               {"cylinder", 0.5, 0.04, CR}};
struct TurningRuns {
  Tally a, b, slope;
  int refused = 0;
};
inline TurningRuns turning_runs(const Turning& body, double slope, Route route, int runs,
                                unsigned seed) {
  simulated::Noise noise(seed);
  TurningRuns all{{body.law.a}, {body.law.b}, {slope}};
  FitOptions options;
  options.fit_slope = true;
  Roll roll({1, body.R, body.K, 9.81, slope}, body.law, 0.5);
  const double turn = roll.stop_time();
  for (int k = 0; k < runs; ++k) {
    const double way = k % 2 ? 1 : -1;
    Run run;
    run.body = {1, body.R, body.K};
    for (double t = 0; t < turn || (t < 3 * turn && roll.at(t).x > 0.02); t += 0.04) {
      run.t.push_back(t);
      run.x.push_back(way * roll.at(t).x + noise(3e-4));
      run.v.push_back(way * roll.at(t).v + noise(5.3e-3));
    }
    try {
      const FitResult r = fit(route, {run}, options);
      all.a.add(r.a, r.sigma_a);
      all.b.add(r.b, r.sigma_b);
      all.slope.add(way * r.scene[0]->value, r.scene[0]->sigma);
    } catch (const Error&) {
      ++all.refused;
    }
  }
  return all;
}

/// Fits of runs of a nominal body that take its numbers from their distributions: the spread of
/// a, b and v0 beside the errors that a fit states, for every hundredth of the runs.
struct InputQuantities {
  Tally a, b, v0;
  double stated_a = 0, stated_b = 0, stated_v0 = 0, stated_corr = 0, corr = 0;
  FitResult first{};  ///< of the runs that state errors
};
inline InputQuantities input_quantities(int draws, unsigned seed) {
  Body body = troubled::cylinder;
  body.slope = 0.002;
  body.exact = true;
  Body uncertain = body;
  uncertain.sigma_R = 4e-4, uncertain.sigma_K = 0.01, uncertain.sigma_g = 0.01;
  uncertain.sigma_slope = 3e-4;
  Roll truth(body, CR, troubled::v0);
  simulated::Noise noise(seed);
  InputQuantities all{{CR.a}, {CR.b}, {troubled::v0}};
  double ab = 0;
  const int stating = (draws + 99) / 100;
  for (int k = 0; k < draws; ++k) {
    Run run{};
    run.body = body;
    for (double t = 0; t < 0.9 * truth.stop_time(); t += 0.05) {
      run.t.push_back(t);
      run.x.push_back(truth.at(t).x + noise(troubled::noise));
    }
    if (k % 100 == 0) {
      run.body = uncertain;
      const FitResult r = fit(Route::position, {run}, {});
      all.stated_a += r.sigma_a / stating;
      all.stated_b += r.sigma_b / stating;
      all.stated_v0 += r.v0[0].sigma / stating;
      all.stated_corr += r.corr / stating;
      if (k == 0) all.first = r;
      run.body = body;
    }
    run.body.K += noise(uncertain.sigma_K);
    run.body.R += noise(uncertain.sigma_R);
    run.body.g += noise(uncertain.sigma_g);
    run.body.slope += noise(uncertain.sigma_slope);
    const FitResult r = fit(Route::position, {run}, {});
    all.a.add(r.a, r.sigma_a);
    all.b.add(r.b, r.sigma_b);
    all.v0.add(r.v0[0].value, r.v0[0].sigma);
    ab += (r.a - CR.a) * (r.b - CR.b);
  }
  all.corr = (ab - all.a.sum * all.b.sum / draws) / (draws - 1) / (all.a.sd() * all.b.sd());
  return all;
}

/// Noisy speeds down to the stop (5.3 mm/s), the slow ones left out.
struct MinSpeed {
  Tally a, b;
};
inline MinSpeed min_speed(PowerLaw law, double limit, int runs, unsigned seed) {
  constexpr double sd = 5.3e-3;
  simulated::Noise noise(seed);
  MinSpeed all{{law.a}, {law.b}};
  FitOptions options;
  options.min_speed = limit;
  Roll truth(troubled::cylinder, law, troubled::v0);
  for (int k = 0; k < runs; ++k) {
    Run run{};
    run.body = troubled::cylinder;
    for (double t = 0; t < truth.stop_time(); t += troubled::dt) {
      run.t.push_back(t);
      run.v.push_back(truth.at(t).v + noise(sd));
    }
    const FitResult r = fit(Route::velocity, {run}, options);
    all.a.add(r.a, r.sigma_a);
    all.b.add(r.b, r.sigma_b);
  }
  return all;
}

/// a where something is done about a trouble of troubles.h: K 3 % wrong is given as 0.515 +- 0.015,
/// and the 0.2 s of the hand are cut off.
inline Tally remedied(const troubled::Trouble& wrong, PowerLaw law, int runs, unsigned seed) {
  troubled::Readings readings(troubled::path(law, wrong), wrong, seed);
  Tally a{law.a};
  for (int k = 0; k < runs; ++k) {
    Run run = readings.next();
    if (wrong.K != troubled::cylinder.K) run.body.sigma_K = wrong.K - troubled::cylinder.K;
    while (wrong.hand > 0 && run.t.front() < wrong.hand)
      run.t.erase(run.t.begin()), run.x.erase(run.x.begin());
    const FitResult r = fit(Route::position, {run}, {});
    a.add(r.a, r.sigma_a);
  }
  return a;
}

}  // namespace studies
