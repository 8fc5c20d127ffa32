// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/model_shift.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "fit/shift_rows.h"

namespace rolling {
namespace {

/// Every k-th row, with k the smallest that leaves at most `most` rows.
ShiftRows thinned(const ShiftRows& rows, std::size_t most) {
  ShiftRows few;
  few.v_ref = rows.v_ref;
  const std::size_t n = rows.y.size();
  for (std::size_t i = 0, step = (n + most - 1) / most; i < n; i += step) {
    few.y.push_back(rows.y[i]);
    few.v.push_back(rows.v[i]);
  }
  few.runs = {few.y.size()};
  return few;
}

/// A starting point: the exponent of a coarse grid with the smallest sum of squares (the height
/// follows by linear least squares), or the values that the user gives. From one exponent of the
/// grid to the next no D changes by more than a factor e^(1/2) relative to D at the mean of ln v.
PowerLaw power_start(const ShiftRows& few, const FitOptions& options) {
  const auto a_given = options.given_a(), b_given = options.given_b();
  std::vector<double> exponents;
  if (b_given) exponents = {*b_given};
  else {
    double widest = 2;
    for (const double v : few.v) widest = std::max(widest, std::abs(std::log(v / few.v_ref)));
    for (double b = -4; b <= 8; b += 0.5 / widest) exponents.push_back(b);
  }
  double least = std::numeric_limits<double>::infinity();
  PowerLaw best{0, 0};
  for (double b : exponents) {
    double mm = 0, mD = 0, rss = 0;
    const PowerLaw unit{std::pow(few.v_ref, -b), b};
    for (std::size_t i = 0; i < few.y.size(); ++i) {
      const double m = unit(few.v[i]);
      mm += m * m;
      mD += m * few.y[i];
    }
    const double a = a_given.value_or(unit.a * mD / mm);
    for (std::size_t i = 0; i < few.y.size(); ++i) {
      const double f = PowerLaw{a, b}(few.v[i]) - few.y[i];
      rss += f * f;
    }
    if (rss < least || exponents.size() == 1) least = rss, best = {a, b};
  }
  return best;
}

}  // namespace

Fitted fit_shift(const std::vector<FitRun>& all, const FitOptions& options) {
  auto rows = std::make_shared<const ShiftRows>(shift_rows(all, options, false));
  double unit = 0;
  for (double D : rows->y) unit = std::max(unit, std::abs(D));
  if (unit == 0) fail("all shifts are 0: b cannot be determined");
  const Parameters q(options, false, unit, rows->v_ref);
  // For many rows, a few thousand of them give a starting point close to the minimum.
  constexpr std::size_t most = 4096;
  const std::size_t n = rows->y.size();
  auto few = std::make_shared<const ShiftRows>(thinned(*rows, options.robust ? n : most));
  std::vector<double> theta = q.theta(power_start(*few, options), {}, {});
  if (few->y.size() < n) theta = attempt(system_of(std::move(few), q), theta).theta;

  System system = system_of(rows, q);
  Minimum minimum = solve(system, {theta}, options);
  Fitted result{.system = std::move(system), .minimum = std::move(minimum)};
  result.rows = n;
  result.left_out = rows->left_out;
  report_law(result, q);
  result.shifts = std::move(rows);
  return result;
}

}  // namespace rolling
