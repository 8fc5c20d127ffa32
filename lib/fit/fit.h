// The power law D(v) = a v^b from records: what goes in, what comes out, and the four routes.
#pragma once

#include "fit/filter.h"
#include "contact/body.h"

#include <optional>
#include <vector>

namespace rolling {

/// One run as a route sees it. loglog and shift read v and D (and t, where filters are known);
/// velocity reads t and v; position t and x. Columns that a route does not read are empty.
struct FitRun {
  std::vector<double> t, x, v, D;
  Body body;            ///< its K, R, g (trajectory routes only)
  FilterChain filters;  ///< what made these columns, in order; empty if nothing is known
};

enum class Route { loglog, shift, velocity, position };

struct FitOptions {
  Geometry geometry = Geometry::approximate;
  std::optional<double> a, b, v0, x0;  ///< held fixed
  std::optional<double>
      origin;  ///< when v0 and x0 hold [s]; else the first fitted record of each run
  std::optional<double> start_a, start_b;  ///< where to start; found from the data otherwise
  double min_speed = 0;                    ///< records slower than this are left out [m/s]
  /// What may have made the speeds of 30 or more records whose filters are not known (velocity
  /// route): differences of x, and means of v to compare with. A difference is believed if the
  /// residuals of the first records of each run are most likely with it, and all of them white once
  /// it is reckoned with.
  std::vector<LinearFilter> possible_filters;
  bool robust = false;  ///< bisquare loss instead of squares; not for filtered columns
};

/// How the standard errors were made; `none` where there are as many parameters as records (the
/// errors and rms are NaN).
enum class Errors { none, classical, filters, differences, autocorrelation };

struct FitResult {
  double a, sigma_a, b, sigma_b;  ///< a [m (s/m)^b]
  double corr;                    ///< correlation of a and b; 0 where one of them is fixed
  double rms;     ///< sqrt(RSS / (n - p)) in the unit of the fitted column (of ln D for loglog)
  std::size_t n;  ///< records that were fitted
  std::size_t left_out;  ///< records that the route could not use
  double whiteness;  ///< significance of the residuals' autocorrelation (Ljung and Box); NaN for
                     ///< filtered v and D
  std::vector<double> v0, sigma_v0, x0, sigma_x0;  ///< trajectory routes, one a run
  Errors errors;
};

/// One joint fit over all runs: one a and b, own v0 and x0 for each run (trajectory routes). Throws
/// Error with one clear line for what cannot be determined: fewer than two points, all v equal, no
/// positive D (loglog), no convergence, a standard error of b above 3.
FitResult fit(Route, const std::vector<FitRun>&, const FitOptions&);

/// How well a law describes the records of a route, by AICc (Burnham and Anderson 2002, Model
/// Selection and Multimodel Inference): smaller is better, differences below 2 say nothing.
/// Infinite where the law cannot be fitted.
struct LawScore {
  const char* law;
  double aicc;
};

/// D = a v^b first, then the coast-down laws D = d0, d0 + d1 v, d0 + d1 v + d2 v^2 on the same
/// records with the same weights (A = 1). Records with correlated residuals count as n (1 - r)/(1 +
/// r) independent ones, r their correlation from one to the next.
std::vector<LawScore> compare_laws(Route, const std::vector<FitRun>&, const FitOptions&);

}  // namespace rolling
