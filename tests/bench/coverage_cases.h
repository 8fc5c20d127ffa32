// SPDX-License-Identifier: GPL-3.0-or-later
// The cases of coverage.h: what becomes of simulated readings before they are fitted.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

#include "fit/input.h"
#include "motion/solved_roll.h"

namespace coverage {

using rolling::Route;
using Column = std::vector<double>;

/// What becomes of the noisy readings before they are fitted.
struct Case {
  const char* name;
  Route route;
  enum Raw { x, v } raw = x;              ///< the column that carries white noise
  std::vector<std::string> history = {};  ///< the filters, as the `##` lines tell them
  Column (*unknown)(const Column& x) =
      nullptr;                ///< or v from x by a sensor's software, of which no line tells
  double resolution = 0;      ///< positions are rounded to this [m]
  bool only_rounded = false;  ///< and have no other noise
  double outliers = 0;        ///< share of readings that are false echoes
  double lost = 0;            ///< share of rows that are missing
  double dropped = 0;         ///< the same, but the times go on as if no row were missing
  double rises = 0;           ///< slope of the mat, which the body rolls up and back
  double noise_of_a = 0;      ///< D is that of an accelerometer, v of another sensor [m/s^2]
  std::size_t law = 0;  ///< another law than a v^b: its number in laws(), and its coefficients
  Column c = {};
  double growth = 0;   ///< the noise grows along the run by so many times its size
  double AR = 0;       ///< correlation of the noise from one reading to the next
  int runs = 1;        ///< that are fitted jointly
  double scatter = 0;  ///< of a from run to run, as a share
  int noisy = 0;       ///< the last so many runs have five times the noise
  int down = 0;        ///< the last so many roll down a slope, which is fitted (positions)
  int digits = 0;      ///< all columns are rounded to so many by the tools
  bool whole = false;  ///< the free roll is sought in the whole run of a sensor
  enum Ending { none, stop, caught, braked, wall } ending = none;  ///< of a whole run, pushed
  double jitter = 0;  ///< standard deviation of the times of the readings, as a share of a step
  double gate = 0;    ///< the times are measured at which x is a multiple of this [m]
  rolling::Bulge bulge{};  ///< of whole runs
  bool bound = false;      ///< white noise on the fitted column: the Cramer-Rao bound holds
  int finer = 1;           ///< so many times as many rows a second
  std::size_t few = 0;     ///< or so many rows in all, evenly from the beginning on
  /// v0 of the fit is that of the scene.
  bool begins_at_v0() const {
    return runs == 1 && !whole && ending == none && gate == 0 &&
           (route == Route::position || route == Route::velocity);
  }
  bool student = false;  ///< the intervals are Student's, for the degrees of freedom of the fit
};

constexpr double dt = 0.04, noise_x = 3e-4,
                 noise_v = noise_x / dt / 1.41421356;  // a sonar at 25 Hz
constexpr double slope = 1e-3;                         // of the mat, where it is fitted

inline double clamped(const Column& x, std::ptrdiff_t i) {
  return x[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, std::ssize(x) - 1))];
}

/// Speeds as PASCO Capstone exports them; at the ends, what is there of them.
inline Column capstone(const Column& x) {
  Column v;
  for (std::ptrdiff_t i = 0; i < std::ssize(x); ++i) {
    const std::ptrdiff_t k = std::min({std::ptrdiff_t{2}, i, std::ssize(x) - 1 - i});
    const double one = clamped(x, i + 1) - clamped(x, i - 1);
    const double two = clamped(x, i + 2) - clamped(x, i - 2);
    if (k == 2) v.push_back((one + two) / (6 * dt));
    else v.push_back(one / ((k == 1 ? 2 : 1) * dt));
  }
  return v;
}

/// Speeds as Vernier Logger Pro exports them: slopes over 1, 2, 3 rows to either side with
/// weights 3, 2, 1.
inline Column logger_pro(const Column& x) {
  Column v;
  const std::ptrdiff_t n = std::ssize(x);
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::ptrdiff_t k = 1; k <= 3; ++k)
      sum +=
          static_cast<double>(4 - k) * (clamped(x, i + k) - clamped(x, i - k)) /
          (static_cast<double>(std::min(i + k, n - 1) - std::max<std::ptrdiff_t>(i - k, 0)) * dt);
    v.push_back(sum / 6);
  }
  return v;
}

/// Speeds as a spreadsheet makes them: over the time since the row before.
inline Column since_the_row_before(const Column& x) {
  Column v;
  for (std::ptrdiff_t i = 0; i < std::ssize(x); ++i)
    v.push_back((clamped(x, std::max<std::ptrdiff_t>(i, 1)) -
                 clamped(x, std::max<std::ptrdiff_t>(i, 1) - 1)) /
                dt);
  return v;
}

/// Speeds as the firmware of a sensor smooths them, which has done so before the first row: it lags
/// by 0.7/0.3 rows.
inline Column exponential(const Column& v) {
  const double lag = 0.7 / 0.3 / static_cast<double>(v.size());
  Column smooth{v.front() + lag * (v.front() - v.back())};
  for (std::size_t i = 1; i < v.size(); ++i) smooth.push_back(0.7 * smooth.back() + 0.3 * v[i]);
  return smooth;
}

inline Column means_of_11(const Column& v) {
  Column means;
  for (std::ptrdiff_t i = 0; i < std::ssize(v); ++i) {
    const std::ptrdiff_t k = std::min({std::ptrdiff_t{5}, i, std::ssize(v) - 1 - i});
    const auto at = v.begin() + i;
    means.push_back(std::reduce(at - k, at + k + 1) / static_cast<double>(2 * k + 1));
  }
  return means;
}

inline Column medians_of_5(const Column& v) {
  Column medians;
  for (std::ptrdiff_t i = 0; i < std::ssize(v); ++i) {
    Column near;
    for (std::ptrdiff_t k = i - 2; k <= i + 2; ++k) near.push_back(clamped(v, k));
    std::ranges::nth_element(near, near.begin() + 2);
    medians.push_back(near[2]);
  }
  return medians;
}

inline std::vector<std::string> to_shift(Case::Raw raw, const std::string& smooth,
                                         const std::string& differentiate = "central") {
  std::vector<std::string> lines;
  if (raw == Case::x) lines.push_back("differentiate x central");
  if (!smooth.empty()) lines.push_back("smooth v " + smooth);
  lines.insert(lines.end(),
               {"differentiate v " + differentiate, "shift-from-accel K 0.5 R 0.04 g 9.81"});
  return lines;
}
inline std::vector<std::string> to_shift(Case::Raw raw, int width) {
  return to_shift(raw, "mean width " + std::to_string(width));
}

struct Scene {
  const char* name;
  double a, b, K = 0.5;

  rolling::PowerLaw law() const { return {a, b}; }
  rolling::Body body() const { return {1.375, 0.04, K}; }
};
constexpr Scene CR{"CR", 1.87e-3, 0.215}, CF{"CF", 5.75e-4, 0.0244};
/// Other exponents, with D(0.5 m/s) as on rubber.
constexpr Scene exponents[] = {{"b=0", 1.611e-3, 0},
                               {"b=.1", 1.727e-3, 0.1},
                               {"b=.3", 1.984e-3, 0.3},
                               {"b=.4", 2.126e-3, 0.4},
                               {"b=.5", 2.278e-3, 0.5}};
/// The shell under the laws of Table 1.
constexpr Scene SR{"SR", 1.78e-3, 0.255, 0.83}, SF{"SF", 5.75e-4, 0.0244, 0.83};

inline std::vector<Case> cases() {
  using enum Route;
  const std::vector<std::string> v_of_x{"differentiate x central"},
      mean_11 = to_shift(Case::x, 11), savgol_31 = to_shift(Case::x, "", "savgol width 31 order 2");
  constexpr rolling::Bulge mat{5e-4, 0.02};
  std::vector<Case> all{
      {.name = "white x", .route = position, .bound = true},
      {.name = "white v", .route = velocity, .raw = Case::v, .bound = true},
      {.name = "v from x, known", .route = velocity, .history = v_of_x},
      {.name = "v from x, smooth 11, known",
       .route = velocity,
       .history = {v_of_x[0], "smooth v mean width 11"}},
      {.name = "v by Capstone", .route = velocity, .unknown = capstone},
      {.name = "v by Logger Pro", .route = velocity, .unknown = logger_pro},
      {.name = "v by a spreadsheet", .route = velocity, .unknown = since_the_row_before},
      {.name = "v, medians of 5", .route = velocity, .raw = Case::v, .unknown = medians_of_5},
      {.name = "v, means of 11", .route = velocity, .raw = Case::v, .unknown = means_of_11},
      {.name = "v, exponential filter", .route = velocity, .raw = Case::v, .unknown = exponential},
      {.name = "x, 2 % of frames dropped", .route = position, .dropped = 0.02},
      {.name = "D, accelerometer, v to 5 mm/s", .route = shift, .raw = Case::v, .noise_of_a = 0.02},
      {.name = "up .02 and back, x", .route = position, .rises = 0.02},
      {.name = "up .02 and back, v", .route = velocity, .raw = Case::v, .rises = 0.02},
      {.name = "d0 + a v^b, x", .route = position, .law = 5, .c = {5e-4, 1.5e-3, 0.7}},
      {.name = "relaxation, x", .route = position, .law = 6, .c = {5e-4, 1e-3, 0.2}},
      {.name = "x to 1 mm", .route = position, .resolution = 1e-3},
      {.name = "x to 0.2 mm, no other noise",
       .route = position,
       .resolution = 2e-4,
       .only_rounded = true},
      {.name = "x to 1 cm, 50 Hz", .route = position, .resolution = 1e-2, .finer = 2},
      {.name = "x, jitter .3 of a step", .route = position, .jitter = 0.3},
      {.name = "D from x, jitter .3 of a step", .route = shift, .history = mean_11, .jitter = 0.3},
      {.name = "gates every 4 cm", .route = position, .gate = 0.04},
      {.name = "pulses every 4 cm", .route = velocity, .gate = 0.04},
      {.name = "v from x to 1 mm, known", .route = velocity, .history = v_of_x, .resolution = 1e-3},
      {.name = "D from x to 1 mm, W 11", .route = shift, .history = mean_11, .resolution = 1e-3},
      {.name = "x, 1 % outliers", .route = position, .outliers = 0.01},
      {.name = "v, 1 % outliers", .route = velocity, .raw = Case::v, .outliers = 0.01},
      {.name = "D from x, mean 11", .route = shift, .history = mean_11},
      {.name = "D from x, 5 % lost", .route = shift, .history = mean_11, .lost = 0.05},
      {.name = "D from x, 10 % lost", .route = shift, .history = mean_11, .lost = 0.1},
      {.name = "D from x, 20 % lost", .route = shift, .history = mean_11, .lost = 0.2},
      {.name = "D from x, savgol 31", .route = shift, .history = savgol_31},
      {.name = "D from x, savgol 31, 10 % lost", .route = shift, .history = savgol_31, .lost = 0.1},
      {.name = "D from x, savgol 31, 20 % lost", .route = shift, .history = savgol_31, .lost = 0.2},
      {.name = "D from x, spline", .route = shift, .history = to_shift(Case::x, "", "spline")},
      {.name = "D from x, mean 11, spline",
       .route = shift,
       .history = to_shift(Case::x, "mean width 11", "spline")},
      {.name = "D from x, AR(1) 0.5", .route = shift, .history = mean_11, .AR = 0.5},
      {.name = "D from x, AR(1) 0.8", .route = shift, .history = mean_11, .AR = 0.8},
      {.name = "D from x, AR(1) 0.95", .route = shift, .history = mean_11, .AR = 0.95},
      {.name = "D from x, --digits 4", .route = shift, .history = mean_11, .digits = 4},
      {.name = "D from x, --digits 3", .route = shift, .history = mean_11, .digits = 3},
      {.name = "D from x, noise grows", .route = shift, .history = mean_11, .growth = 10},
      {.name = "x, AR(1) 0.5", .route = position, .AR = 0.5},
      {.name = "x, AR(1) 0.8", .route = position, .AR = 0.8},
      {.name = "x, AR(1) 0.95", .route = position, .AR = 0.95},
      {.name = "x, noise grows", .route = position, .growth = 10},
      {.name = "x, 10 % lost", .route = position, .lost = 0.1},
      {.name = "v, AR(1) 0.8", .route = velocity, .raw = Case::v, .AR = 0.8},
      {.name = "x, 4 kHz", .route = position, .finer = 160},
      {.name = "D from x, 4 kHz", .route = shift, .history = mean_11, .finer = 160},
      {.name = "D from x, 4 kHz, 1 % lost",
       .route = shift,
       .history = mean_11,
       .lost = 0.01,
       .finer = 160},
      {.name = "x, 15 rows, Student's t", .route = position, .few = 15, .student = true},
      {.name = "x, 8 rows, Student's t", .route = position, .few = 8, .student = true},
      {.name = "x, 6 rows, Student's t", .route = position, .few = 6, .student = true},
      {.name = "x, 5 rows, Student's t", .route = position, .few = 5, .student = true},
      {.name = "x, 15 rows", .route = position, .few = 15},
      {.name = "x, 8 rows", .route = position, .few = 8},
      {.name = "x, 6 rows", .route = position, .few = 6},
      {.name = "x, 5 rows", .route = position, .few = 5},
      {.name = "pushed, to the stop, x", .route = position, .ending = Case::stop},
      {.name = "caught in 0.3 s, x", .route = position, .ending = Case::caught},
      {.name = "braked, x", .route = position, .ending = Case::braked},
      {.name = "against a wall, x", .route = position, .ending = Case::wall},
      {.name = "whole run, x", .route = position, .whole = true},
      {.name = "whole run, D", .route = shift, .history = mean_11, .whole = true},
      {.name = "whole run with memory, x", .route = position, .whole = true, .bulge = mat},
      {.name = "whole run with memory, D",
       .route = shift,
       .history = mean_11,
       .whole = true,
       .bulge = mat},
      // Runs that agree, and runs that scatter by 2 %.
      {.name = "2 runs, x", .route = position, .runs = 2},
      {.name = "4 runs, x", .route = position, .runs = 4},
      {.name = "4 runs, D from x, mean 11", .route = shift, .history = mean_11, .runs = 4},
      {.name = "4 runs, D from x, W 15",
       .route = loglog,
       .history = to_shift(Case::x, 15),
       .runs = 4},
      {.name = "4 runs, x, AR(1) 0.8", .route = position, .AR = 0.8, .runs = 4},
      {.name = "4 runs, x, noise grows", .route = position, .growth = 10, .runs = 4},
      {.name = "4 runs, x, 2 % scatter", .route = position, .runs = 4, .scatter = 0.02},
      {.name = "10 runs, x, 2 % scatter", .route = position, .runs = 10, .scatter = 0.02},
      {.name = "4 runs, D, 2 % scatter",
       .route = shift,
       .history = mean_11,
       .runs = 4,
       .scatter = 0.02},
      {.name = "1 + 3 noisy, x, 2 % scatter",
       .route = position,
       .runs = 4,
       .scatter = 0.02,
       .noisy = 3},
      {.name = "2 + 2 noisy, x, 2 % scatter",
       .route = position,
       .runs = 4,
       .scatter = 0.02,
       .noisy = 2},
      {.name = "4 + 4 noisy, x, 2 % scatter",
       .route = position,
       .runs = 8,
       .scatter = 0.02,
       .noisy = 4},
      {.name = "7 up + 1 down, x, 2 % scatter",
       .route = position,
       .runs = 8,
       .scatter = 0.02,
       .down = 1},
      {.name = "4 up + 4 down, x, 2 % scatter",
       .route = position,
       .runs = 8,
       .scatter = 0.02,
       .down = 4},
      {.name = "1 + 1 noisy, x, 5 % outliers",
       .route = position,
       .outliers = 0.05,
       .runs = 2,
       .noisy = 1}};
  static const char* const names[][4] = {
      {"D from v, W 5", "D from v, W 9", "D from v, W 15", "D from v, W 31"},
      {"D from x, W 5", "D from x, W 9", "D from x, W 15", "D from x, W 31"}};
  constexpr int widths[] = {5, 9, 15, 31};
  for (Route route : {shift, loglog})
    for (Case::Raw raw : {Case::v, Case::x})
      for (int i = 0; i < 4; ++i)
        all.push_back({.name = names[raw == Case::x][i],
                       .route = route,
                       .raw = raw,
                       .history = to_shift(raw, widths[i])});
  return all;
}

}  // namespace coverage
