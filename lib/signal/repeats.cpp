// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/repeats.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "base/median.h"
#include "base/grid.h"

namespace rolling {
namespace {

/// The unit of a grid on which the readings lie: the largest step of which three in five steps
/// are whole multiples, to 2 % of the unit or to the place; a step of fewer than 8 places must be
/// exact. Otherwise the smallest step, but no more than 8 places, since a coarser grid would show.
/// A few steps may be off the grid, as where a lost reading changes the time between two others.
double unit_of(std::span<const double> all_steps, double place, double rounding) {
  constexpr std::size_t enough = 500;  // steps to look at
  std::vector<double> steps;
  for (std::size_t i = 0; i < all_steps.size(); i += 1 + all_steps.size() / enough)
    steps.push_back(all_steps[i]);
  std::ranges::sort(steps, std::greater());
  const auto off = [=](double unit) {
    return unit < 8 * place ? 2 * rounding : std::max(0.02 * unit, place);
  };
  for (std::size_t i = 0; i < steps.size();) {
    // The mean of all steps that are equal but for rounding.
    const double least = steps[i] - off(steps[i]);
    double sum = 0, count = 0;
    for (; i < steps.size() && steps[i] > least; ++i) sum += steps[i], ++count;
    const double unit = sum / count;
    const auto multiples = std::ranges::count_if(steps, [&](double step) {
      return step > unit / 2 && std::abs(step - std::round(step / unit) * unit) <= off(unit);
    });
    if (5 * static_cast<std::size_t>(multiples) >= 3 * steps.size()) return unit;
  }
  return std::clamp(steps.back(), place, 8 * place);
}

}  // namespace

double rows_held(std::span<const double> readings) {
  double largest = 0;
  for (const double y : readings) largest = std::max(largest, std::abs(y));
  const double rounding = program_rounding * largest;
  const auto step = [&](std::size_t i) { return std::abs(readings[i] - readings[i - 1]); };
  std::vector<double> steps;  // other than 0
  for (std::size_t i = 1; i < readings.size(); ++i)
    if (step(i) > rounding) steps.push_back(step(i));
  if (steps.empty() || 4 * steps.size() >= 3 * readings.size()) return 1;
  const double unit = unit_of(steps, grid_of(readings) + rounding, rounding);
  std::size_t waiting = 0, held = 0, stretches = 0;  // held between two jumps
  bool after_jump = false;
  for (std::size_t i = 1; i < readings.size(); ++i) {
    if (step(i) <= rounding) {
      waiting += readings[i] != 0;
      continue;
    }
    const bool jump = step(i) > 2.5 * unit;
    if (jump && after_jump) held += waiting, ++stretches;
    after_jump = jump;
    waiting = 0;
  }
  if (3 * held <= stretches) return 1;
  // In each stretch one step is not 0. Chernoff's bound for so large a share of zeros by chance.
  const double zero = std::min(unit / (2 * median(steps)), 0.5),
               n = static_cast<double>(held + stretches), share = static_cast<double>(held) / n,
               distance = share * std::log(share / zero) +
                          (1 - share) * std::log((1 - share) / (1 - zero));
  if (share <= zero || std::exp(-n * distance) > 0.01) return 1;
  return 1 + static_cast<double>(held) / static_cast<double>(stretches);
}

}  // namespace rolling
