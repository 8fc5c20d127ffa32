// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/cusps.h"

#include "base/dot.h"
#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rolling {
namespace {

/// The derivative of the stop of a run by the columns of that run: by differences, for a start need
/// not be precise.
std::vector<double> slopes_of_stop(const RollModel& rolls, const System& system,
                                   std::vector<double> theta, std::size_t run) {
  std::vector<double> slopes;
  for (std::size_t j = 0; j < system.columns(); ++j) {
    double& x = theta[system.place(run, j)];
    const double at = x, step = 1e-5 * std::max(1.0, std::abs(at));
    const auto stop = [&](double value) {
      x = value;
      return rolls.roll(theta, run).stop_time();
    };
    slopes.push_back((stop(at + step) - stop(at - step)) / (2 * step));
    x = at;
  }
  return slopes;
}

/// The change of theta for each second by which the stop of a run comes later, that raises the sum
/// of squares least: C g/(g C g), with the covariance C and the slopes g of the stop.
std::vector<double> later_stop(const System& system, const std::vector<double>& R,
                               std::vector<double> g, std::size_t run) {
  const std::size_t q = system.columns();
  solve_transposed(&R[run * q * q], g);
  const double square = dot(g, g);
  std::vector<double> change(system.parameters());
  for (std::size_t r = 0; r < system.runs.size(); ++r) {
    std::vector<double> x = g;
    if (r != run) std::fill_n(x.begin(), system.own, 0);
    for (double& value : x) value /= square;
    solve_upper(&R[r * q * q], x);
    for (std::size_t j = 0; j < q; ++j) change[system.place(r, j)] = x[j];
  }
  return change;
}

/// Times in the interval between two rows that holds the stop, and in those beside it: most of
/// them close to the row before, where the speed of that row changes fastest. None if the
/// stop is beyond all rows.
std::vector<double> other_stops(const std::vector<double>& t, double stop) {
  const auto n = t.size(),
             next = static_cast<std::size_t>(std::ranges::upper_bound(t, stop) - t.begin());
  std::vector<double> stops;
  if (n < 2 || !(stop < 2 * t[n - 1] - t[n - 2])) return stops;
  for (std::size_t i = std::max<std::size_t>(next, 2) - 1; i <= std::min(next + 1, n); ++i) {
    const double step = i < n ? t[i] - t[i - 1] : t[i - 1] - t[i - 2];
    for (const double share : {1.0 / 64, 1.0 / 8, 1.0 / 2})
      stops.push_back(t[i - 1] + share * step);
  }
  return stops;
}

/// Searches again from starts around the stop of one run. Throws Error, and leaves `best` as it is,
/// if the roll has no stop close to this one.
void search_around(const RollModel& rolls, const System& system, std::size_t run, Minimum& best) {
  const std::vector<double> from = best.theta;
  const double stop = rolls.roll(from, run).stop_time();
  const std::vector<double> stops = other_stops(rolls.runs()[run].t, stop);
  if (stops.empty()) return;
  const std::vector<double> later =
      later_stop(system, best.R, slopes_of_stop(rolls, system, from, run), run);
  for (const double other : stops) {
    std::vector<double> start = from;
    for (std::size_t j = 0; j < start.size(); ++j) start[j] += (other - stop) * later[j];
    if (Minimum found = attempt(system, start); found.rss < best.rss) best = std::move(found);
  }
}

/// True if the second derivative of the speed before the stop is unbounded. On a slope the body
/// slows down at a rate that is not 0 at the stop, as with b = 0.
bool has_cusps(const RollModel& rolls, const std::vector<double>& theta, std::size_t run) {
  const auto law = rolls.parameters().law(theta).power();  // another stops as a constant one
  return !rolls.runs()[run].raw_is_position &&
         (law.value_or(PowerLaw{1, 0}).b < 0.5 || rolls.slope(theta, run) != 0) &&
         !rolls.roll(theta, run).turns();  // it does not rest: v goes on through 0
}

}  // namespace

Minimum beyond_cusps(const RollModel& rolls, const System& system, Minimum best) {
  constexpr std::size_t many = 2048;  // rows times runs
  if (system.residuals() * system.runs.size() > many) return best;
  for (double before = std::numeric_limits<double>::infinity(); best.rss < before * (1 - 1e-6);) {
    before = best.rss;
    for (std::size_t r = 0; r < system.runs.size(); ++r) try {
        if (has_cusps(rolls, best.theta, r)) search_around(rolls, system, r, best);
      } catch (const Error&) {  // the roll has no stop near this one: its minimum stays
      }
  }
  return best;
}

}  // namespace rolling
