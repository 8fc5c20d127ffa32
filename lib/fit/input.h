// SPDX-License-Identifier: GPL-3.0-or-later
// What is fitted to the rows of runs: the route, and which coefficients of a law D(v) are fixed.
#pragma once

#include "law/law.h"
#include "noise/run.h"

#include <array>
#include <optional>
#include <vector>

namespace rolling {

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

}  // namespace rolling
