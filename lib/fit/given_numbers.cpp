#include "fit/given_numbers.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "contact/contact.h"
#include "contact/uncertain_number.h"
#include "fit/route.h"

namespace rolling {

namespace {

Estimate given(Route route, const FitRun& run, const UncertainNumber& number) {
  if (is_trajectory(route)) return {run.body.*number.value, run.given.*number.sigma};
  if (!run.shift_of) return {};
  return {run.shift_of->body.*number.value, run.shift_of->given.*number.sigma};
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
Fitted fit_with(Route route, std::vector<FitRun> runs, const FitOptions& options,
                const UncertainNumber& number, const Estimate& value, double by) {
  for (FitRun& run : runs)
    if (given(route, run, number) == value) move(route, run, number, by);
  return fit_route(route, runs, options);
}

}  // namespace

std::vector<ErrorShare> shares_of_given(Route route, const std::vector<FitRun>& runs,
                                        const FitOptions& options, const Fitted& fit) {
  FitOptions warm = options;
  warm.start_a = fit.a.value;
  warm.start_b = fit.b.value;
  std::vector<ErrorShare> all;
  for (const UncertainNumber& number : uncertain_numbers) {
    std::vector<Estimate> values;
    for (const FitRun& run : runs) {
      const Estimate value = given(route, run, number);
      if (value.sigma > 0 && std::ranges::find(values, value) == values.end())
        values.push_back(value);
    }
    for (const Estimate& value : values) {
      const double step = value.value == 0 || number.value == &Body::slope
                              ? value.sigma
                              : std::min(value.sigma, 0.1 * std::abs(value.value));
      const Fitted above = fit_with(route, runs, warm, number, value, step),
                   below = fit_with(route, runs, warm, number, value, -step);
      const auto change = [&](const Quantity& high, const Quantity& low) {
        return (high.value - low.value) / 2 * value.sigma / step;
      };
      ErrorShare& share = all.emplace_back();
      share.of = values.size() == 1 ? number.name : fmt::format("{} {}", number.name, value.value);
      const double a = change(above.a, below.a), b = change(above.b, below.b);
      share.a = std::abs(a), share.b = std::abs(b), share.together = a * b;
      share.slope = fit.slope ? change(*above.slope, *below.slope) : 0;
      for (std::size_t r = 0; r < fit.v0.size(); ++r)
        share.v0.push_back(change(above.v0[r], below.v0[r]));
    }
  }
  return all;
}

}  // namespace rolling
