// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/shift_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/median.h"
#include "base/grid.h"
#include "fit/roll_fit.h"

namespace rolling {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The sign of the velocities of a run up to a stop or a turning point.
double way_of(const FitRun& run, double stop) {
  double sum = 0;
  for (std::size_t i = 0; i < run.v.size(); ++i)
    if (std::isfinite(run.v[i]) && (stop == never || run.t[i] < stop)) sum += run.v[i];
  return sum < 0 ? -1 : 1;
}

/// What is left where the terms of a sum cancel: a share of the median size, which no single
/// reading can shift, of about a thousand readings.
double rounding_of(const std::vector<double>& column) {
  std::vector<double> sizes;
  for (std::size_t i = 0; i < column.size(); i += 1 + column.size() / 1000)
    if (std::isfinite(column[i])) sizes.push_back(std::abs(column[i]));
  return sizes.empty() ? 0 : program_rounding * median(sizes);
}

/// A starting point: the exponent of a coarse grid with the smallest sum of squares (the height
/// follows by linear least squares), or the values that are fixed; of a few thousand of the rows.
/// From one exponent of the grid to the next no D changes by more than a factor e^(1/2) relative to
/// D at the mean of ln v.
PowerLaw power_start(const std::vector<ObservedRun>& runs, double v_ref,
                     const FitOptions& options) {
  constexpr std::size_t most = 4096;
  std::size_t n = 0;
  for (const ObservedRun& run : runs) n += run.y.size();
  std::vector<double> v, D;
  double widest = 2;
  for (const ObservedRun& run : runs)
    for (std::size_t i = 0; i < run.y.size(); i += (n + most - 1) / most) {
      v.push_back(run.t[i]), D.push_back(run.y[i]);
      widest = std::max(widest, std::abs(std::log(v.back() / v_ref)));
    }
  std::vector<double> exponents;
  if (options.b) exponents = {*options.b};
  else
    for (double b = -4; b <= 8; b += 0.5 / widest) exponents.push_back(b);
  double least = std::numeric_limits<double>::infinity();
  PowerLaw best{0, 0};
  for (double b : exponents) {
    const PowerLaw unit{std::pow(v_ref, -b), b};
    double mm = 0, mD = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double m = unit(v[i]);
      mm += m * m, mD += m * D[i];
    }
    const double height = options.a ? *options.a / unit.a : mD / mm,
                 rss = height * (height * mm - 2 * mD);  // but for the squares of D
    if (height > 0 && rss < least) least = rss, best = {unit.a * height, b};
  }
  if (best.a == 0) fail("D is 0 or has the other sign than v, as if the mat drove the body on");
  return best;
}

}  // namespace

Rows shift_rows(const FitRun& run, const FitOptions& options, bool logarithms, double stop) {
  const double way = way_of(run, stop), least_v = rounding_of(run.v),
               least_D = logarithms ? rounding_of(run.D) : -std::numeric_limits<double>::infinity();
  Rows rows;
  for (std::size_t i = 0; i < run.v.size(); ++i) {
    const double v = way * run.v[i], D = way * run.D[i];
    if (v > least_v && v >= options.min_speed && std::isfinite(v) && std::isfinite(D) &&
        D > least_D && (stop == never || run.t[i] < stop))
      rows.push_back(i);
  }
  return rows;
}

std::vector<ObservedRun> observed_shifts(const std::vector<FitRun>& all, const FitOptions& options,
                                         bool logarithms, const std::vector<double>& stops) {
  std::vector<ObservedRun> runs;
  std::vector<double> speeds;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const FitRun& run = all[r];
    const double stop = stops.empty() ? never : stops[r], way = way_of(run, stop);
    const Rows rows = shift_rows(run, options, logarithms, stop);
    if (rows.empty()) continue;
    ObservedRun& seen = runs.emplace_back();
    seen.column = logarithms ? RawColumn::ln_D : RawColumn::D;
    for (const std::size_t i : rows) {
      seen.t.push_back(way * run.v[i]);
      seen.y.push_back(logarithms ? std::log(way * run.D[i]) : way * run.D[i]);
    }
    speeds.insert(speeds.end(), seen.t.begin(), seen.t.end());
  }
  require_rows(speeds.size(), !options.a + !options.b, speeds.size());
  if (!options.b && std::ranges::all_of(speeds, [&](double v) { return v == speeds[0]; }))
    fail("all speeds are equal: b cannot be determined");
  return runs;
}

Parameters parameters_of_shifts(const std::vector<ObservedRun>& runs, const FitOptions& options) {
  double sum = 0, n = 0;
  for (const ObservedRun& run : runs)
    for (const double v : run.t) sum += std::log(v), ++n;
  return {options, std::exp(sum / n)};
}

Fitted fit_shift(const std::vector<FitRun>& all, const FitOptions& options) {
  std::vector<ObservedRun> runs = observed_shifts(all, options, false);
  const Parameters q = parameters_of_shifts(runs, options);
  const PowerLaw start = power_start(runs, q.speed_unit(), options);
  return fit_from({q, {q.theta(start, {}, {})}}, std::move(runs), std::make_shared<const Noise>(),
                  options);
}

}  // namespace rolling
