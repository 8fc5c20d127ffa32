#include "fit/given_numbers.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "contact/contact.h"
#include "contact/uncertain_number.h"

namespace rolling {
namespace {

bool rolls_by_time(Route route) { return route == Route::velocity || route == Route::position; }

Estimate given(Route route, const FitRun& run, const UncertainNumber& number) {
  if (rolls_by_time(route)) return {run.body.*number.value, run.given.*number.sigma};
  if (!run.shift_of) return {};
  return {run.shift_of->body.*number.value, run.shift_of->given.*number.sigma};
}

bool same(const Estimate& x, const Estimate& y) { return x.value == y.value && x.sigma == y.sigma; }

void move(Route route, FitRun& run, const UncertainNumber& number, double by) {
  if (rolls_by_time(route)) {
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
    if (same(given(route, run, number), value)) move(route, run, number, by);
  return fit_route(route, runs, options);
}

}  // namespace

std::vector<Moved> moved_by_given(Route route, const std::vector<FitRun>& runs,
                                  const FitOptions& options, const Fitted& fit) {
  FitOptions warm = options;
  warm.start_a = fit.a.value;
  warm.start_b = fit.b.value;
  std::vector<Moved> all;
  for (const UncertainNumber& number : uncertain_numbers) {
    std::vector<Estimate> values;
    for (const FitRun& run : runs) {
      const Estimate value = given(route, run, number);
      if (value.sigma > 0 && std::none_of(values.begin(), values.end(),
                                          [&](const Estimate& x) { return same(x, value); }))
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
      Moved& moved = all.emplace_back();
      moved.by = values.size() == 1 ? number.name : fmt::format("{} {}", number.name, value.value);
      moved.a = change(above.a, below.a);
      moved.b = change(above.b, below.b);
      moved.slope = fit.slope ? change(*above.slope, *below.slope) : 0;
      for (std::size_t r = 0; r < fit.v0.size(); ++r)
        moved.v0.push_back(change(above.v0[r], below.v0[r]));
    }
  }
  return all;
}

}  // namespace rolling
