// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/shift_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/median.h"
#include "base/grid.h"

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
PowerLaw power_start(const ShiftRows& rows, const FitOptions& options) {
  constexpr std::size_t most = 4096;
  const std::size_t n = rows.y.size(), step = (n + most - 1) / most;
  std::vector<double> exponents;
  if (options.b) exponents = {*options.b};
  else {
    double widest = 2;
    for (const double v : rows.v) widest = std::max(widest, std::abs(std::log(v / rows.v_ref)));
    for (double b = -4; b <= 8; b += 0.5 / widest) exponents.push_back(b);
  }
  double least = std::numeric_limits<double>::infinity();
  PowerLaw best{0, 0};
  for (double b : exponents) {
    double mm = 0, mD = 0, DD = 0;
    const PowerLaw unit{std::pow(rows.v_ref, -b), b};
    for (std::size_t i = 0; i < n; i += step) {
      const double m = unit(rows.v[i]), D = rows.y[i];
      mm += m * m, mD += m * D, DD += D * D;
    }
    const double height = options.a ? *options.a / unit.a : mD / mm,
                 rss = DD + height * (height * mm - 2 * mD);
    if (height > 0 && rss < least) least = rss, best = {unit.a * height, b};
  }
  if (best.a == 0) fail("D has the other sign than v, as if the mat drove the body on");
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

ShiftRows shift_rows(const std::vector<FitRun>& all, const FitOptions& options, bool logarithms,
                     const std::vector<double>& stops) {
  ShiftRows rows;
  rows.logarithms = logarithms;
  double sum = 0;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const FitRun& run = all[r];
    const double stop = stops.empty() ? never : stops[r], way = way_of(run, stop);
    const Rows used = shift_rows(run, options, logarithms, stop);
    if (logarithms) rows.negative += shift_rows(run, options, false, stop).size() - used.size();
    for (const std::size_t i : used) {
      rows.v.push_back(way * run.v[i]);
      rows.y.push_back(logarithms ? std::log(way * run.D[i]) : way * run.D[i]);
      sum += std::log(rows.v.back());
    }
    rows.runs.push_back(used.size());
  }
  const std::size_t n = rows.y.size();
  require_rows(n, !options.a + !options.b, n);
  if (!options.b && std::ranges::all_of(rows.v, [&](double v) { return v == rows.v[0]; }))
    fail("all speeds are equal: b cannot be determined");
  rows.v_ref = std::exp(sum / static_cast<double>(n));
  return rows;
}

System system_of(std::shared_ptr<const ShiftRows> rows, const Parameters& q) {
  const std::size_t p = q.columns();
  const std::vector<std::size_t>& runs = rows->runs;
  return {runs, 0, p,
          [rows = std::move(rows), q, p](const std::vector<double>& theta, const TakeRows& take) {
    const Law law = q.law(theta);
    std::size_t i = 0;
    for (std::size_t r = 0; r < rows->runs.size(); ++r) {
      std::vector<double> f(rows->runs[r]), J(f.size() * p);
      for (std::size_t k = 0; k < f.size(); ++k, ++i) {
        std::array<double, LawForm::most> by_c{};
        const double D = law.at(rows->v[i], by_c.data()).D;
        f[k] = (rows->logarithms ? std::log(D) : D) - rows->y[i];
        if (rows->logarithms)
          for (double& by : by_c) by /= D;
        q.chain(&J[k], f.size(), law.c(0), {by_c});
      }
      take(r, f, J);
    }
          }};
}

Fitted fit_shift(const std::vector<FitRun>& all, const FitOptions& options) {
  auto rows = std::make_shared<const ShiftRows>(shift_rows(all, options, false));
  if (std::ranges::all_of(rows->y, [](double D) { return D == 0; }))
    fail("all shifts are 0: b cannot be determined");
  const Parameters q(options, rows->v_ref);
  Fitted fit{.system = system_of(rows, q), .minimum = {}};
  fit.minimum = solve(fit.system, {q.theta(power_start(*rows, options), {}, {})}, options);
  fit.rows = rows->y.size();
  fit.parameters = q;
  fit.shifts = std::move(rows);
  report(fit);
  return fit;
}

}  // namespace rolling
