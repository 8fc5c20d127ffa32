// SPDX-License-Identifier: GPL-3.0-or-later
// The input of a fit of a law D(v), of D = a v^b if no other is named: the rows of the runs,
// whether their columns are what their filters make of each other, and what is fitted.
#pragma once

#include "base/quantity.h"
#include "contact/contact.h"
#include "contact/law.h"
#include "noise/response.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace rolling {

/// The acceleration [m/s^2] from which the shift D [m] of a body was computed, by Eq. 11 or by the
/// exact root of Eq. 9. For A = 1 the relation is linear and holds for any D.
inline double acceleration_of(const Body& body, double D) {
  if (body.exact) check_shift(body, D);
  return accelerate(body, D).a;
}

/// The data of one run in SI units: t [s], x [m], v [m/s], D [m], one element for each row. The
/// routes loglog and shift read v and D (and t, where the filters are known); velocity reads t and
/// v; position reads t and x.
struct Run {
  std::vector<double> t, x, v, a, D;
  std::vector<double>& operator[](Quantity q) { return this->*columns[q]; }
  const std::vector<double>& operator[](Quantity q) const { return this->*columns[q]; }
  static const PerQuantity<std::vector<double> Run::*> columns;

  double x0 = 0;        ///< where speeds begin on the road of the body
  Body body;            ///< the body and its mat: K, R, g and slope (trajectory routes only); runs
                        ///< that give the same number with the same uncertainty share its error
  FilterChain filters;  ///< the filters that made the fitted columns of x alone or of v alone, in
                        ///< order; empty if they are unknown. In the chain, the column D stands for
                        ///< the acceleration from which shift_of computed D.
  std::optional<Body> shift_of = {};  ///< the body for which the column D was computed
  std::string name = {};              ///< for messages
};

inline constexpr PerQuantity<std::vector<double> Run::*> Run::columns{
    {&Run::t, &Run::x, &Run::v, &Run::a, &Run::D}};

enum class Route { loglog, shift, velocity, position };
/// True if the route fits v or x as a function of t; the others fit D(v).
inline bool is_trajectory(Route route) {
  return route == Route::velocity || route == Route::position;
}

/// The column that is fitted; of shifts behind known filters it is that of the speeds (model.h).
inline Quantity fitted_column(Route route) {
  return route == Route::position ? Quantity::x : Quantity::v;
}

struct FitOptions {
  const LawForm* law = &laws().front();  ///< a v^b, or the law that is fitted instead
  bool fits_power() const { return law == &laws().front(); }
  /// The coefficients of the law that are fixed [SI], and v0 and x0.
  using Fixed = std::array<std::optional<double>, LawForm::most>;
  Fixed fixed = {};
  std::optional<double> v0, x0;
  bool fit_slope = false;      ///< the slope of the mat is a further parameter, common to all runs
  bool fit_wind = false;       ///< so is the wind, of a law with the drag of the air
  bool fit_steepness = false;  ///< so is the factor of the height of a road
  bool fit_x0 = false;         ///< so is where each run of speeds begins on it
  double min_speed = 0;        ///< rows slower than this are not fitted [m/s]
  /// Filters that the software of a sensor may have applied to the speeds (velocity route,
  /// levels::least_tested rows, no known filter): differences of x, and for comparison means of v.
  std::vector<LinearFilter> possible_filters;
  bool robust = false;  ///< bisquare loss instead of squares; not for filtered columns
};

/// A number of the road or of the air that may be a parameter, common to all runs.
struct SceneNumber {
  const char* name;
  const char* unit_of_value;
  double Body::*value;
  bool FitOptions::*is_fitted;
  double unit;  ///< of its element of theta
};
inline constexpr std::size_t place_of_wind = 2;  ///< its place among them, the last
inline constexpr std::array<SceneNumber, 3> scene_numbers{
    {{"slope", "", &Body::slope, &FitOptions::fit_slope, 1e-3},
     {"steepness", "", &Body::steepness, &FitOptions::fit_steepness, 1},
     {"wind", "m/s", &Body::wind, &FitOptions::fit_wind, 1}}};

/// The body of a run on this route, with the uncertainties of its numbers.
inline Body body_of(Route route, const Run& run) {
  return is_trajectory(route) ? run.body : run.shift_of.value_or(Body{});
}

/// How a run differs from its filters.
struct Mismatch {
  bool inside = false;              ///< the columns are not those of these filters
  bool begin = false, end = false;  ///< only there, where a window may reach beyond the run
};

/// Applies the filters again to the columns of the run that no later filter has changed (x, v, and
/// for D the acceleration from which shift_of computed it) and compares each column that they make.
/// What differs from it by the rounding of the numbers, or by much less than its noise, is the
/// same. Columns that are missing, and the windows of missing readings, are not compared.
Mismatch mismatch(const FilterChain&, const Run&);

}  // namespace rolling
