// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/errors.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "contact/body.h"
#include "contact/contact.h"
#include "fit/fitted.h"

namespace rolling {

namespace {

/// The body of a run, with the uncertainties of its numbers, and the geometry of the route.
ShiftOf body_of(Route route, const FitRun& run, const FitOptions& options) {
  if (is_trajectory(route)) return {run.body, options.geometry, run.given};
  return run.shift_of.value_or(ShiftOf{});
}

Estimate given(const ShiftOf& by, const UncertainNumber& number) {
  return {by.body.*number.value, by.given.*number.sigma};
}

void move(Route route, FitRun& run, const UncertainNumber& number, double by) {
  if (is_trajectory(route)) {
    run.body.*number.value += by;
    return;
  }
  ShiftOf to = *run.shift_of;
  to.body.*number.value += by;
  for (double& D : run.D)
    if (std::isfinite(D))
      D = shift_from_acceleration(to.body, to.geometry, acceleration_of(*run.shift_of, D));
  run.shift_of = to;
}

/// The fit after the number has changed by `by` in each run that has this value and uncertainty.
Fitted fit_with(Route route, std::vector<FitRun> runs, const FitOptions& options, bool agree,
                const UncertainNumber& number, const Estimate& value, double by) {
  for (FitRun& run : runs)
    if (given(body_of(route, run, options), number) == value) move(route, run, number, by);
  return agree ? fit_route(route, runs, options) : fit_of_disagreeing(route, runs, options);
}

/// True if all runs have this value, and D alone depends on it, in proportion to (K + 1) R/g. With
/// A = 1 on a level mat v and x depend on a g/((K + 1) R) (Eq. 12), and D is (K + 1) R/g times the
/// deceleration (Eq. 11).
bool scales_a(Route route, const std::vector<FitRun>& runs, const FitOptions& options,
              const UncertainNumber& number, const Estimate& value) {
  if (options.a || options.fit_slope || number.value == &Body::slope) return false;
  return std::ranges::all_of(runs, [&](const FitRun& run) {
    const ShiftOf by = body_of(route, run, options);
    return given(by, number) == value && by.geometry == Geometry::approximate && by.body.slope == 0;
  });
}

}  // namespace

std::vector<ErrorShare> shares_of_given(Route route, const std::vector<FitRun>& runs,
                                        const FitOptions& options, const Fitted& fit, bool agree) {
  const auto numbers = fit.numbers();
  std::vector<ErrorShare> all;
  for (const UncertainNumber& number : uncertain_numbers) {
    std::vector<Estimate> values;
    for (const FitRun& run : runs) {
      const Estimate value = given(body_of(route, run, options), number);
      if (value.sigma > 0 && std::ranges::find(values, value) == values.end())
        values.push_back(value);
    }
    for (const Estimate& value : values) {
      const double step = value.value == 0 || number.value == &Body::slope
                              ? value.sigma
                              : std::min(value.sigma, 0.1 * std::abs(value.value));
      std::vector<double> changes(numbers.size(), 0);
      const auto change = [&](double high, double low) {
        return (high - low) / 2 * value.sigma / step;
      };
      if (scales_a(route, runs, options, number, value)) {
        const auto unit = [&](double by) {
          Body body = body_of(route, runs.front(), options).body;
          body.*number.value += by;
          return (body.K + 1) * body.R / body.g;
        };
        for (std::size_t j = 0; j < fit.coefficients.size(); ++j)
          changes[j] = options.law->coefficients[j].D * fit.coefficients[j].value *
                       change(unit(step), unit(-step)) / unit(0);
      } else {
        const auto above = fit_with(route, runs, options, agree, number, value, step).numbers(),
                   below = fit_with(route, runs, options, agree, number, value, -step).numbers();
        for (std::size_t j = 0; j < numbers.size(); ++j)
          changes[j] = change(above[j].value, below[j].value);
      }
      all.push_back(
          {values.size() == 1 ? number.name : fmt::format("{} {}", number.name, value.value),
           outer_square(changes)});
    }
  }
  return all;
}

}  // namespace rolling
