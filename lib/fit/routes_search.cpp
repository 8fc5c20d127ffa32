// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "fit/routes.h"
#include "least_squares/minimise.h"

namespace rolling {
namespace {

/// The sum of the squares of speeds, as a function of the time T of the stop, has a cusp at each
/// row where b < 1/2: the speed just before the stop grows like (T - t)^(1/(1 - b)), whose
/// second derivative is unbounded. So the sum may have a minimum in each interval between two
/// rows, and Gauss-Newton steps do not leave it. This function starts the search again with T
/// earlier and later, up to the interval beside that of the minimum, until no such start leads to a
/// smaller sum. Positions are smoother by one order, and nothing is done.
///
/// The minima differ the less the more rows there are: above 2048 rows times runs nothing is done.
Minimum beyond_cusps(const Model& rolls, const System& system, Minimum best) {
  constexpr std::size_t many = 2048;  // rows times runs
  const auto& runs = rolls.runs();
  if (runs.front().column == Quantity::x || system.own == 0 ||
      system.residuals() * runs.size() > many)
    return best;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const double end = runs[r].t.back();
    const double step = end / static_cast<double>(std::max<std::size_t>(runs[r].t.size(), 2) - 1);
    for (double before = INFINITY; best.rss < before * (1 - 1e-6);) {
      before = best.rss;
      for (const double rows : {-1.0, -0.5, -0.25, -0.1, 0.1, 0.25, 0.5, 1.0}) try {
          Roll roll = rolls.roll(best.theta, r);
          if (roll.turns() || !(roll.stop_time() < end + step)) break;
          const Roll::Point first = roll.at(0);
          std::vector<double> start = best.theta;
          start[system.place(r, 0)] *= 1 - rows * step * first.a / first.v;
          improve(best, system, start);
        } catch (const Error&) {  // there is no roll whose stop is then
        }
    }
  }
  return best;
}

/// True if the gradient of the sum of squares is not 0, by a hundredth of a standard deviation.
bool ends_at_an_edge(const Minimum& at) {
  const std::size_t n = at.f.size();
  const std::size_t p = at.theta.size();
  return n > p && at.R.reduction() * static_cast<double>(n - p) > 1e-4 * at.rss;
}

/// True if b is free and a run goes uphill at theta, or on a road: the sum of squares has a wall at
/// b = 0.
bool has_wall(const Model& rolls, const std::vector<double>& theta) {
  const Parameters& q = rolls.parameters();
  if (!rolls.is_roll() || &q.form() != &laws().front() || q.fixed(1)) return false;
  return std::ranges::any_of(rolls.runs(), [&](const ObservedRun& run) {
    return run.body.road || run.way * q.body(theta, run.body).slope > 0;
  });
}

/// The minimum from this start. A search may end at the wall before it is at the lowest place
/// there, or behind it. If it does, this function goes along the wall, and on from there.
Minimum minimise_along_wall(const Model& rolls, const std::vector<double>& start) {
  const System system = system_of(rolls);
  if (!has_wall(rolls, start)) return minimise(system, start);
  Minimum best{start};
  improve(best, system, start);
  const Parameters& q = rolls.parameters();
  const bool before_wall = std::isfinite(best.rss) && q.law(best.theta).power()->b > 0;
  if (before_wall && !ends_at_an_edge(best)) return best;
  const auto at_wall = minimum_at_wall(rolls, best.theta);
  if (!at_wall) return minimise(system, start);
  improve(best, system, at_wall->theta);
  return best.rss < at_wall->rss ? best : evaluated(system, at_wall->theta);
}

/// True if all runs are rolls in one direction, and none turns.
bool go_one_way(const Model& rolls) {
  return rolls.is_roll() && std::ranges::all_of(rolls.runs(), [&](const ObservedRun& run) {
           return run.way == rolls.runs().front().way &&
                  way_before_turn(run.column == Quantity::x, run.t, run.y) == 0;
         });
}

}  // namespace

Minimum with_exponent_held(const Model& rolls, std::vector<double> theta, double b) {
  const Parameters& q = rolls.parameters();
  const auto exponent = static_cast<std::ptrdiff_t>(q.count() - q.scene() - 1);
  theta.erase(theta.begin() + exponent);
  Minimum found{theta};
  improve(found, system_of(rolls.with(q.with(q.first_of_law + 1, b))), theta);
  found.theta.insert(found.theta.begin() + exponent, b);
  return {std::move(found.theta), {}, {}, found.rss};  // R has no column for b
}

std::optional<Minimum> minimum_at_wall(const Model& rolls, const std::vector<double>& theta) {
  if (!has_wall(rolls, theta)) return {};
  Minimum found = with_exponent_held(rolls, theta, 0);
  if (!std::isfinite(found.rss)) return {};
  return found;
}

Minimum search(const Model& model, const std::vector<std::vector<double>>& starts,
               const FitOptions& options) {
  const System system = system_of(model);
  if (options.robust) return minimise_robust(system, starts);
  return beyond_cusps(model, system, minimise_along_wall(model, starts.front()));
}

void refuse_one_way(const std::string& found) {
  fail<OneWay>("a slope and the law slow the body down alike, and these runs go one way{}", found);
}

Fitted fit_from(Model model, const std::vector<std::vector<double>>& starts,
                const FitOptions& options) {
  Fitted fit{};
  fit.model = std::move(model);
  try {
    fit.minimum = search(fit.model, starts, options);
  } catch (const Error& error) {
    const bool not_one = error.kind == NotOneRoll;
    if (not_one && options.fit_slope && go_one_way(fit.model)) refuse_one_way();
    throw;
  }
  read_off(fit);
  return fit;
}

}  // namespace rolling
