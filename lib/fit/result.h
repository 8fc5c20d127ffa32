// SPDX-License-Identifier: GPL-3.0-or-later
// What a fit finds: the law, its errors and their sources, and what the residuals show beside it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/estimate.h"
#include "base/matrix.h"
#include "law/law.h"
#include "fit/input.h"
#include "statistics/run_laws.h"

namespace rolling {

/// The estimator of the standard errors. none: there are as many parameters as rows, and the
/// errors and rms are NaN. classical: independent noise of equal variance. filters: the covariance
/// of the known filters. differences: the covariance of a difference filter that was inferred from
/// the residuals. uneven: consistent for noise of unequal variance (HC3). autocorrelation:
/// consistent for autocorrelated noise (Newey and West).
enum class Errors { none, classical, filters, differences, uneven, autocorrelation };

/// An eccentric body: the centre of mass lies a distance e from the axis. Its weight then has a
/// torque of period one turn, as if the shift were D + e cos(x/R - phase), with x = 0 at the
/// beginning of the run.
struct Eccentricity {
  std::size_t run;  ///< the number of the run, from 0
  double p;         ///< the probability that noise alone gives a signal as large
  double e, sigma;  ///< the eccentricity and its standard error [m]
  double phase;     ///< [rad]
};

/// Single readings that are off the motion of the others, see off_readings().
struct OffReadings {
  std::size_t run;      ///< the number of the run, from 0
  std::size_t count;    ///< of the readings of that run; 0 if none is off
  double time;          ///< of the reading that is furthest off [s]
  double distance = 0;  ///< of that reading, in standard deviations of the others
};

/// A place where the clock of a run jumps, see jump_of_clock().
struct ClockJump {
  double time;  ///< of the first row behind it [s]
  double by;    ///< what the times lack from there on [s]
  double p;     ///< the probability that noise alone seems to jump so
};

/// The contribution of one source of error to the standard errors, which are the root sums of
/// squares of the contributions. That of an input quantity is the change of the result when the
/// quantity changes by one standard uncertainty.
struct ErrorShare {
  /// "noise"; the name of an input quantity, "K", or "K 0.5" where the runs have several; or "bias"
  std::string of;
  Matrix covariance;  ///< contribution to that of Fitted::numbers(), first of the coefficients

  double sigma(std::size_t number) const { return std::sqrt(covariance[number][number]); }
};

/// An interval of 95 % of a number by the profile of the sum of squares, see
/// intervals_not_visited(). An end is infinite if the readings do not bound it.
struct Interval {
  std::size_t number;  ///< of the coefficient; those of the scene follow the last one
  double lower, upper;
};

/// The covariance that a change brings when it has a standard uncertainty of one.
inline Matrix outer_square(const std::vector<double>& change) {
  Matrix all;
  for (const double x : change)
    for (all.emplace_back(); const double y : change) all.back().push_back(x * y);
  return all;
}

struct FitResult {
  Law law;
  std::vector<Estimate> coefficients = {};  ///< as the formula of the law names them, in SI units
  Matrix correlations = {};                 ///< 0 where one of the two is fixed
  /// The same of a v^b; NaN for another law.
  double a = NAN, sigma_a = NAN, b = NAN, sigma_b = NAN, corr = NAN;
  double rms;     ///< sqrt(RSS / (n - p)) in the unit of the fitted column (of ln D for loglog)
  std::size_t n;  ///< number of fitted rows
  std::size_t freedom;       ///< degrees of freedom of the errors, see Fitted::degrees_left()
  std::size_t left_out = 0;  ///< number of rows, but for missing ones, that the route did not use
  std::size_t negative;      ///< of these, those with D <= 0 whose noise loglog does not know
  double whiteness;          ///< p of the autocorrelation of the noise (Ljung and Box); NaN
                             ///< where it is not tested
  double reversals = 1;      ///< p of so few steps against the motion, see few_reversals()
  /// At the first row [m/s], of each run (trajectory routes). Of several runs only the first has an
  /// error.
  std::vector<Estimate> v0 = {};
  std::vector<Estimate> x0 = {};  ///< likewise [m] (positions)
  /// The numbers of the scene, as far as they were fitted.
  std::array<std::optional<Estimate>, scene_numbers.size()> scene = {};
  Errors errors;
  std::optional<Eccentricity> eccentricity = {};  ///< of the run with the signal of the smallest p
  std::optional<Agreement> agreement = {};        ///< for two or more runs
  OffReadings off = {};                           ///< of the run with the reading furthest off
  std::optional<ClockJump> clock_jump = {};       ///< the largest, of a run by itself
  double clock_noise = 0;                         ///< see noise_of_clock()
  std::vector<ErrorShare> shares = {};            ///< the noise first
  std::vector<Interval> not_visited = {};         ///< in place of 1.96 standard errors
};

/// True if the noise is autocorrelated, by a small p. The standard errors allow for that if there
/// are levels::least_tested rows.
inline bool noise_is_correlated(const FitResult& r) { return r.whiteness <= levels::not_white; }

/// For a fit by loglog. Noise makes the logarithms of D too low, by rms^2 / 2 on average (to second
/// order). The function is true if this is more than the standard error of the line at the speed
/// where the line is known best, sigma_a / a sqrt(1 - corr^2). It is also true if more than one
/// row in a hundred has D <= 0: the standard deviation of D is then 0.43 D or more, and the
/// logarithms of the others are too low by 0.1, or too high where many are left out.
inline bool logarithms_biased(const FitResult& r) {
  return 100 * r.negative > r.n + r.negative ||
         (r.rms * r.rms / 2 > r.sigma_a / r.a * std::sqrt(1 - r.corr * r.corr) && r.sigma_a > 0);
}

}  // namespace rolling
