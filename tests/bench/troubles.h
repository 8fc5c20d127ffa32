// SPDX-License-Identifier: GPL-3.0-or-later
// What a run really has: simulated runs with one thing wrong in each, and what fitpower says
// of them; and runs under each law that it compares. `make coverage` prints both tables; a test
// takes a short form.
#pragma once

#include "base/error.h"
#include "law/law.h"
#include "fit/refits.h"
#include "fit/fit.h"
#include "fit/fitted.h"
#include "unit/fit/simulated.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace troubled {

constexpr double dt = 0.04, noise = 3e-4, v0 = 0.5;  // a sonar at 25 Hz
constexpr double better = 10;
inline const rolling::Body cylinder{1.375, 0.04, 0.5};

/// What is wrong with an experiment.
struct Trouble {
  const char* name;
  double slope = 0;
  double drag = 0;             ///< v' has -drag v [1/s]
  double K = 0.5;              ///< as the fit is told
  double scale = 1;            ///< of the sensor
  double eccentricity = 0;     ///< [m]
  double aside = 0;            ///< the sensor stands so far off the line [m], 0.3 m behind
  double least = 1, most = 1;  ///< the noise, at the end and at the beginning
  double AR = 0;
  double outliers = 0;  ///< then --robust
  double hand = 0;      ///< a hand keeps the speed for so long [s]
};

/// Positions every dt, to the stop, under D(v); Runge-Kutta with 100 steps a row.
inline std::vector<double> path(const std::function<double(double)>& D, const Trouble& wrong) {
  constexpr int steps = 100;
  constexpr double h = dt / steps, limit = 60;
  const double arm = (cylinder.K + 1) * cylinder.R / cylinder.g;
  double x = 0, v = v0, t = 0;
  std::vector<double> all{0};
  const auto acceleration = [&](double at, double u) {
    if (t < wrong.hand) return 0.0;
    const double e = wrong.eccentricity * std::sin(at / cylinder.R);
    return -(D(std::max(u, 1e-12)) + e + cylinder.R * wrong.slope) / arm - wrong.drag * u;
  };
  while (t < limit) {
    for (int i = 0; i < steps && v > 0; ++i, t += h) {
      const double k1 = acceleration(x, v), k2 = acceleration(x + h / 2 * v, v + h / 2 * k1),
                   v2 = v + h / 2 * k1, v3 = v + h / 2 * k2, k3 = acceleration(x + h / 2 * v2, v3),
                   v4 = v + h * k3, k4 = acceleration(x + h * v3, v4);
      x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
      v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    if (!(v > 0)) break;
    all.push_back(x);
  }
  return all;
}

/// The same path again and again, each time with other noise.
class Readings {
 public:
  Readings(std::vector<double> x, const Trouble& wrong, unsigned seed)
      : path_(std::move(x)), wrong_(wrong), noise_(seed), random_(seed + 1) {}

  rolling::Run next() {
    rolling::Run run{};
    run.body = cylinder;
    run.body.K = wrong_.K;
    double error = 0;
    for (std::size_t i = 0; i < path_.size(); ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(path_.size()),
                   size = noise * (wrong_.most + (wrong_.least - wrong_.most) * share);
      error = wrong_.AR * error + noise_(i ? std::sqrt(1 - wrong_.AR * wrong_.AR) : 1);
      const double x = wrong_.aside > 0 ? std::hypot(0.3 + path_[i], wrong_.aside) : path_[i];
      run.t.push_back(dt * static_cast<double>(i));
      run.x.push_back(wrong_.scale * x + size * error);
      if (uniform() < wrong_.outliers) run.x.back() += uniform() - 0.5;
    }
    return run;
  }

 private:
  double uniform() { return static_cast<double>(random_()) / 4294967296.0; }

  std::vector<double> path_;
  Trouble wrong_;
  simulated::Noise noise_;
  std::mt19937 random_;
};

/// What is said of runs of the law D = a v^b with one trouble: shares of the runs.
struct Verdict {
  double bias = 0;  ///< of a, in parts of a
  double cover_a = 0, cover_b = 0, adequate = 0;
  double noise = 0, eccentric = 0;                                 ///< warnings
  double other_law = 0, beginning = 0, not_white = 0, failed = 0;  ///< of --check
  double told = 0;              ///< --check fails, or a warning speaks of the body
  double e = 0, covered_e = 0;  ///< mean eccentricity where it was found
  int refused = 0;
};

inline Verdict judge(const Trouble& wrong, rolling::PowerLaw law, int runs, unsigned seed) {
  Readings readings(path(law, wrong), wrong, seed);
  rolling::FitOptions options;
  options.robust = wrong.outliers > 0;
  Verdict sum;
  for (int i = 0; i < runs; ++i) {
    const rolling::Run run = readings.next();
    try {
      const auto r = rolling::fit(rolling::Route::position, {run}, options);
      sum.bias += (r.a / law.a - 1) / runs;
      sum.cover_a += std::abs(r.a - law.a) < 1.96 * r.sigma_a;
      sum.cover_b += std::abs(r.b - law.b) < 1.96 * r.sigma_b;
      sum.noise += rolling::noise_is_correlated(r) || r.errors == rolling::Errors::uneven;
      if (r.eccentricity) {
        ++sum.eccentric;
        sum.e += r.eccentricity->e;
        sum.covered_e +=
            std::abs(r.eccentricity->e - wrong.eccentricity) < 1.96 * r.eccentricity->sigma;
      }
      double against = 0;
      if (!options.robust)
        against = rolling::compare_laws(rolling::Route::position, {run}, options).against;
      sum.adequate += !(against > 2);
      const bool other = against >= better, coloured = r.whiteness <= rolling::levels::not_white,
                 hand = !options.robust &&
                        rolling::disturbed_beginning(rolling::Route::position, {run}, options);
      sum.other_law += other;
      sum.beginning += hand;
      sum.not_white += coloured;
      sum.failed += other || hand || coloured;
      sum.told += other || hand || coloured || r.eccentricity;
    } catch (const rolling::Error&) {
      ++sum.refused;
    }
  }
  if (sum.eccentric > 0) sum.e /= sum.eccentric, sum.covered_e /= sum.eccentric;
  for (double* share : {&sum.cover_a, &sum.cover_b, &sum.adequate, &sum.noise, &sum.eccentric,
                        &sum.other_law, &sum.beginning, &sum.not_white, &sum.failed, &sum.told})
    *share /= runs;
  return sum;
}

/// The share of runs in which the most powerful test of whether the fitted roll is right finds
/// the trouble, with one false alarm in 200: of its squares in units of the noise, where there is
/// none, the root is so far above 0 (Neyman and Pearson). No test that knows less finds more.
inline double best_power(const Trouble& wrong, rolling::PowerLaw law) {
  if (wrong.least != wrong.most || wrong.AR != 0 || wrong.outliers > 0) return NAN;
  Trouble quiet = wrong;
  quiet.least = quiet.most = 1e-6;  // of the noise, so that the fit is one of its own errors
  const auto run = Readings(path(law, wrong), quiet, 1).next();
  const auto fit = rolling::fit_route(rolling::Route::position, {run}, {});
  return 0.5 * std::erfc((2.576 - std::sqrt(fit.minimum.rss) / noise) / std::sqrt(2.0));
}

inline std::vector<Trouble> troubles() {
  return {{.name = "nothing"},
          {.name = "mat 1 mm/m off level", .slope = 1e-3},
          {.name = "mat 5 mm/m", .slope = 5e-3},
          {.name = "viscous drag 0.02/s", .drag = 0.02},
          {.name = "K 3 % wrong", .K = 0.515},
          {.name = "scale of the sensor 1 % wrong", .scale = 1.01},
          {.name = "eccentricity 30 um", .eccentricity = 3e-5},
          {.name = "sensor 5 cm off the line", .aside = 0.05},
          {.name = "noise grows, 0.1 to 1.1 mm", .least = 1.1 / 0.3, .most = 0.1 / 0.3},
          {.name = "noise AR(1), 0.95", .AR = 0.95},
          {.name = "2 % outliers, --robust", .outliers = 0.02},
          {.name = "hand on for 0.2 s", .hand = 0.2}};
}

/// A law of law/law.h with coefficients such as a mat may have.
struct Truth {
  std::size_t law;
  std::vector<double> c;
};
inline std::vector<Truth> truths() {
  return {{0, {1.87e-3, 0.215}},   {1, {5.75e-4}},    {2, {1e-3, 1.5e-3}},
          {3, {6e-4, 3e-3, 6e-3}}, {4, {8e-4, 4e-3}}, {5, {8e-4, 2e-2, 4}},
          {6, {3e-4, 8e-4, 0.08}}};
}

/// For the runs of one law: beside each law, in how many the AICc of the true one is 10 or more
/// away from that of the other, and in how many of those it is the smaller.
struct Contest {
  std::vector<int> apart, won;
  double cover = 0;  ///< share of the true law's coefficients within 1.96 of their standard errors
  int not_determined = 0;
};

inline Contest contest(const Truth& truth, int runs, unsigned seed) {
  const rolling::LawForm& law = rolling::laws()[truth.law];
  const auto made = rolling::Law(law, truth.c);
  Readings readings(path([&](double v) { return made.at(v).D; }, {}), {.name = ""}, seed);
  Contest all{std::vector<int>(rolling::laws().size()), std::vector<int>(rolling::laws().size())};
  for (int i = 0; i < runs; ++i) {
    const auto fits = rolling::compare_laws(rolling::Route::position, {readings.next()}, {}).fits;
    const auto& own = fits[truth.law];
    if (own.coefficients.empty()) {
      ++all.not_determined;
      continue;
    }
    for (std::size_t j = 0; j < own.coefficients.size(); ++j)
      all.cover +=
          (std::abs(own.coefficients[j].value - truth.c[j]) < 1.96 * own.coefficients[j].sigma) /
          static_cast<double>(own.coefficients.size() * static_cast<std::size_t>(runs));
    for (std::size_t j = 0; j < fits.size(); ++j) {
      if (std::abs(fits[j].aicc - own.aicc) < better) continue;
      ++all.apart[j];
      all.won[j] += own.aicc < fits[j].aicc;
    }
  }
  return all;
}

}  // namespace troubled
