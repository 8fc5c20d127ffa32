// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/refits.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "contact/body.h"
#include "contact/contact.h"
#include "fit/fitted.h"

namespace rolling {

namespace {

void move(Route route, Run& run, const NumberOfBody& number, double by) {
  if (is_trajectory(route)) {
    run.body.*number.value += by;
    return;
  }
  Body to = *run.shift_of;
  to.*number.value += by;
  for (double& D : run.D)
    if (std::isfinite(D)) D = shift_from_acceleration(to, acceleration_of(*run.shift_of, D));
  run.shift_of = to;
}

/// True if all runs have this value, and D alone depends on it, in proportion to (K + 1) R/g. With
/// A = 1 on a level mat v and x depend on a g/((K + 1) R) (Eq. 12), and D is (K + 1) R/g times the
/// deceleration (Eq. 11).
bool scales_a(Route route, const std::vector<Run>& runs, const FitOptions& options,
              const NumberOfBody& number, const Estimate& value) {
  if (options.fit_slope || number.value == &Body::slope) return false;
  for (std::size_t j = 0; j < options.law->coefficients.size(); ++j)
    if (options.fixed[j] && options.law->coefficients[j].D > 0) return false;
  return std::ranges::all_of(runs, [&](const Run& run) {
    const Body body = body_of(route, run);
    return number.of(body) == value && !body.exact && body.slope == 0;
  });
}

}  // namespace

std::vector<ErrorShare> shares_of_inputs(Route route, const std::vector<Run>& runs,
                                         const FitOptions& options, const Fitted& fit, bool agree) {
  std::vector<ErrorShare> all;
  for (const NumberOfBody& number : uncertain_numbers) {
    std::vector<Estimate> values;
    for (const Run& run : runs) {
      const Estimate value = number.of(body_of(route, run));
      if (value.sigma > 0 && std::ranges::find(values, value) == values.end())
        values.push_back(value);
    }
    for (const Estimate& value : values) {
      // The numbers of the fit after this one has changed in each run that has it.
      const auto numbers_with = [&](double by) {
        std::vector<FittedNumber> numbers = fit.numbers();
        if (scales_a(route, runs, options, number, value)) {
          Body body = body_of(route, runs.front());
          const double unit = (body.K + 1) * body.R / body.g;
          body.*number.value += by;
          for (std::size_t j = 0; j < fit.coefficients.size(); ++j)
            if (options.law->coefficients[j].D > 0)
              numbers[j].value *= (body.K + 1) * body.R / body.g / unit;
          return numbers;
        }
        std::vector<Run> changed = runs;
        for (Run& run : changed)
          if (number.of(body_of(route, run)) == value) move(route, run, number, by);
        return (agree ? fit_route : fit_of_disagreeing)(route, changed, options).numbers();
      };
      const double step = value.value == 0 || number.value == &Body::slope
                              ? value.sigma
                              : std::min(value.sigma, 0.1 * std::abs(value.value));
      const auto above = numbers_with(step);
      const auto below = numbers_with(-step);
      std::vector<double> changes;
      for (std::size_t j = 0; j < above.size(); ++j)
        changes.push_back((above[j].value - below[j].value) / 2 * value.sigma / step);
      all.push_back(
          {values.size() == 1 ? number.name : fmt::format("{} {}", number.name, value.value),
           outer_square(changes)});
    }
  }
  return all;
}

}  // namespace rolling
