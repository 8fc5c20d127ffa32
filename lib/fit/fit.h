// The fit of the power law D(v) = a v^b to records: its input, its result, and its four routes.
#pragma once

#include "base/estimate.h"
#include "contact/body.h"
#include "fit/filter.h"

#include <optional>
#include <string>
#include <vector>

namespace rolling {

/// How a column D was computed from accelerations: by Eq. 11 or by the exact root of Eq. 9, for
/// this body.
struct ShiftOf {
  Body body;
  Geometry geometry = Geometry::approximate;
  BodyUncertainty given = {};  ///< the standard uncertainties of K, R, g and the slope
};
/// The acceleration [m/s^2] from which the shift D [m] was computed. For A = 1 the relation is
/// linear and holds for any D.
double acceleration_of(const ShiftOf&, double D);

/// The data of one run in SI units: t [s], x [m], v [m/s], D [m], one element for each record. The
/// routes loglog and shift read v and D (and t, where the filters are known); velocity reads t and
/// v; position reads t and x. Columns that the route does not read are empty.
struct FitRun {
  std::vector<double> t, x, v, D;
  Body body;            ///< the body and its mat: K, R, g and slope (trajectory routes only)
  FilterChain filters;  ///< the filters that produced these columns, in order; empty if they are
                        ///< unknown. In the chain, the column D stands for the acceleration from
                        ///< which shift_of computed D.
  std::optional<ShiftOf> shift_of = {};
  BodyUncertainty given = {};  ///< the standard uncertainties of `body`; runs that give the same
                               ///< number with the same uncertainty share its error
  std::string name = {};       ///< for messages
};

enum class Route { loglog, shift, velocity, position };
/// True if the route fits v or x as a function of t; the others fit D(v).
inline bool is_trajectory(Route route) {
  return route == Route::velocity || route == Route::position;
}

struct FitOptions {
  Geometry geometry = Geometry::approximate;
  std::optional<double> a, b, v0, x0;      ///< parameters that are held fixed
  std::optional<double> start_a, start_b;  ///< starting values; without them they are estimated
  bool fit_slope = false;  ///< the slope of the mat is a further parameter, common to all runs
  double min_speed = 0;    ///< records slower than this are not fitted [m/s]
  /// Filters that the software of a sensor may have applied to the speeds (velocity route, 30 or
  /// more records, no known filter): differences of x, and for comparison means of v.
  std::vector<LinearFilter> possible_filters;
  bool robust = false;  ///< bisquare loss instead of squares; not for filtered columns
};

/// The estimator of the standard errors. none: there are as many parameters as records, and the
/// errors and rms are NaN. classical: independent noise of equal variance. filters: the covariance
/// of the known filters. differences: the covariance of a difference filter that was inferred from
/// the residuals. uneven: consistent for noise of unequal variance (HC3). autocorrelation:
/// consistent for autocorrelated noise (Newey and West).
enum class Errors { none, classical, filters, differences, uneven, autocorrelation };

/// An eccentric body: the centre of mass lies a distance e from the axis. Its weight then has a
/// torque of period one turn, as if the shift were D + e cos(x/R - phase), with x = 0 at the
/// beginning of the run.
struct Eccentricity {
  std::size_t run;      ///< the number of the run, from 0
  double significance;  ///< the probability that noise alone gives a signal as large
  double e, sigma;      ///< the eccentricity and its standard error [m]
  double phase;         ///< [rad]
};

/// The comparison of the runs of a joint fit, each fitted by its own law, and the run that differs
/// most from the others.
struct Agreement {
  double chi2 = 0;  ///< chi-square of the differences of the laws; its expected value is dof
  std::size_t dof = 0;
  double significance = 1;  ///< the probability that noise alone makes the runs differ as much
  std::size_t runs = 0;     ///< the number of runs that determine a law
  std::size_t run = 0;      ///< the run that differs most from the others, from 0
  double speed = 1;         ///< the speed at which D of that run is known best [m/s]
  Estimate log_D = {};      ///< ln D of that run minus ln D of the others at that speed
  Estimate b = {};          ///< the exponent of that run minus the exponent of the others

  bool agree() const { return significance > 0.01; }
};

/// The contribution of one source of error to the standard errors, which are the root sums of
/// squares of the contributions. That of a given number is the change of the result when the number
/// changes by one standard uncertainty.
struct ErrorShare {
  /// "noise"; the name of a given number, "K", or "K 0.5" where the runs have several; or "bias"
  std::string of;
  double a = 0, b = 0;  ///< not negative
  double together = 0;  ///< contribution to the covariance of a and b
  double slope = 0;
  std::vector<double> v0 = {};  ///< one for each run, if the model is a roll
};

struct FitResult {
  double a, sigma_a, b, sigma_b;  ///< a [m (s/m)^b]
  double corr;                    ///< correlation of a and b; 0 where one of them is fixed
  double rms;     ///< sqrt(RSS / (n - p)) in the unit of the fitted column (of ln D for loglog)
  std::size_t n;  ///< number of fitted records
  std::size_t left_out;  ///< number of records that the route could not use
  double whiteness;      ///< significance of the autocorrelation of the noise (Ljung and Box); NaN
                         ///< where it is not tested
  std::vector<double> v0, sigma_v0;  ///< initial speeds [m/s], one for each run (trajectory routes)
  double slope = 0, sigma_slope = 0;  ///< the slope of the mat, if it was fitted
  Errors errors;
  std::optional<Eccentricity> eccentricity = {};  ///< of the run with the most significant signal
  std::optional<Agreement> agreement = {};        ///< for two or more runs
  std::vector<ErrorShare> shares = {};            ///< the noise first
};

/// At or below this significance of the Ljung-Box test the noise is taken as not white. The test is
/// made at two numbers of lags, so that about 0.6 % of the records with white noise fall below it.
inline constexpr double not_white = 0.003;
/// True if the noise is significantly autocorrelated and the standard errors allow for that.
bool noise_is_correlated(const FitResult&);

/// For a fit by loglog. Noise makes the logarithms of D too low, by rms^2 / 2 on average (to second
/// order). The function is true if this is more than the standard error of the line at the speed
/// where the line is known best, sigma_a / a sqrt(1 - corr^2).
bool logarithms_too_low(const FitResult&);

/// Fits all runs jointly: a and b are common to the runs, v0 and x0 belong to each run. Where the
/// runs disagree, a and b are the means of the runs' own values (agreement.h). Throws Error with a
/// one-line message if the data do not determine the result: too few records, all v equal, no
/// positive D (loglog), no convergence, a standard error of b above 3, a slope that cannot be
/// separated from a.
FitResult fit(Route, const std::vector<FitRun>&, const FitOptions&);

}  // namespace rolling
