// The power law D(v) = a v^b from records: what goes in, what comes out, and the four routes.
#pragma once

#include "base/estimate.h"
#include "contact/body.h"
#include "fit/filter.h"

#include <optional>
#include <string>
#include <vector>

namespace rolling {

/// How a column D was made of accelerations: by Eq. 11 or by the exact root of Eq. 9 for this body.
struct ShiftOf {
  Body body;
  Geometry geometry = Geometry::approximate;
  BodyUncertainty given = {};  ///< the standard uncertainties of K, R, g and the slope
};
/// The acceleration of which a shift was made. With A = 1 it is linear and holds for any D.
double acceleration_of(const ShiftOf&, double D);

/// One run as a route sees it. loglog and shift read v and D (and t, where filters are known);
/// velocity reads t and v; position t and x. Columns that a route does not read are empty.
struct FitRun {
  std::vector<double> t, x, v, D;
  Body body;            ///< its K, R, g and slope (trajectory routes only)
  FilterChain filters;  ///< what made these columns, in order; empty if nothing is known. Its
                        ///< column D is the acceleration that shift_of made D of.
  std::optional<ShiftOf> shift_of = {};
  BodyUncertainty given = {};  ///< of `body`; runs with the same number and uncertainty share it
};

enum class Route { loglog, shift, velocity, position };

struct FitOptions {
  Geometry geometry = Geometry::approximate;
  std::optional<double> a, b, v0, x0;      ///< held fixed
  std::optional<double> start_a, start_b;  ///< where to start; found from the data otherwise
  bool fit_slope = false;  ///< the slope of the mat is one more parameter of all runs
  double min_speed = 0;    ///< records slower than this are left out [m/s]
  /// Filters that the program of a sensor may have applied to the speeds of 30 or more records of
  /// which no filter is known (velocity route): differences of x, and means of v to compare with.
  std::vector<LinearFilter> possible_filters;
  bool robust = false;  ///< bisquare loss instead of squares; not for filtered columns
};

/// How the standard errors were made: from as many parameters as records (there are none: they and
/// rms are NaN); classically; from the known filters; from differences that the residuals show;
/// consistent for noise of uneven size (HC3); from the autocorrelation of the residuals.
enum class Errors { none, classical, filters, differences, uneven, autocorrelation };

/// The centre of mass of a body lies e off its axis: its weight then turns the body back and forth
/// once a turn, as if the shift were D + e cos(x/R - phase), x from the beginning of the run.
struct Eccentricity {
  std::size_t run;      ///< counted from 0
  double significance;  ///< the chance of residuals that show it as clearly, from noise alone
  double e, sigma;      ///< and its standard error [m]
  double phase;         ///< [rad]
};

/// How the runs of a joint fit compare, each with a law of its own, and which one stands out.
struct Agreement {
  double chi2 = 0;  ///< of the differences of their laws; on average as large as dof
  std::size_t dof = 0;
  double significance = 1;  ///< the chance of runs that differ as much, from noise alone
  std::size_t runs = 0;     ///< that determine a law
  std::size_t run = 0;      ///< that is furthest from the others, counted from 0
  double speed = 1;         ///< at which its D is known best [m/s]
  Estimate log_D = {};      ///< ln of its D there less that of the others, with standard error
  Estimate b = {};          ///< its exponent less that of the others

  bool agree() const { return significance > 0.01; }
};

/// What one source of error brings to the standard errors; they are the roots of the sums of the
/// squares.
struct ErrorShare {
  /// "noise"; the given number, "K", or "K 0.5" where runs have several; the expected "bias"
  std::string of;
  double a, b;
};

struct FitResult {
  double a, sigma_a, b, sigma_b;  ///< a [m (s/m)^b]
  double corr;                    ///< correlation of a and b; 0 where one of them is fixed
  double rms;     ///< sqrt(RSS / (n - p)) in the unit of the fitted column (of ln D for loglog)
  std::size_t n;  ///< records that were fitted
  std::size_t left_out;  ///< records that the route could not use
  double whiteness;      ///< significance of the autocorrelation of the noise (Ljung and Box); NaN
                         ///< where it is not tested
  std::vector<double> v0, sigma_v0;   ///< trajectory routes, one a run
  double slope = 0, sigma_slope = 0;  ///< where it was fitted
  Errors errors;
  std::optional<Eccentricity> eccentricity = {};  ///< of the run that shows it best; see there
  std::optional<Agreement> agreement = {};        ///< of two or more runs
  std::vector<ErrorShare> shares = {};            ///< of the errors, the noise first
};

/// At so small a significance the noise is not white: of two tests, some 0.6 % of false alarms.
inline constexpr double not_white = 0.003;
/// The noise is correlated beyond doubt, and the errors allow for it.
bool noise_is_correlated(const FitResult&);

/// For a fit by loglog. Noise makes logarithms too low, those of D by rms^2 / 2 on average (to
/// second order): true if that is more than the standard error of the line at the speed
/// where it is known best, sigma_a / a sqrt(1 - corr^2).
bool logarithms_too_low(const FitResult&);

/// One joint fit over all runs: one a and b, own v0 and x0 for each run. Where the
/// runs disagree, a and b are the means of their own (agreement.h). Throws Error with
/// one clear line for what cannot be determined: fewer than two points, all v equal, no positive D
/// (loglog), no convergence, a standard error of b above 3, a slope that cannot be told from a.
FitResult fit(Route, const std::vector<FitRun>&, const FitOptions&);

}  // namespace rolling
