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

}  // namespace

Minimum search(const Model& model, const System& system,
               const std::vector<std::vector<double>>& starts, const FitOptions& options) {
  return options.robust ? minimise_robust(system, starts)
                        : beyond_cusps(model, system, minimise(system, starts.front()));
}

Fitted fit_from(const FirstGuess& start, std::vector<ObservedRun> runs,
                std::shared_ptr<const Noise> noise, const FitOptions& options) {
  Model model(std::move(runs), start.parameters);
  Minimum minimum = search(model, system_of(model, noise), start.starts, options);
  Fitted fit{.minimum = std::move(minimum), .noise = std::move(noise), .model = std::move(model)};
  read_off(fit);
  return fit;
}

}  // namespace rolling
