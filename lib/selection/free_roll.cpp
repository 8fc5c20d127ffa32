// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/free_roll.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/grid.h"
#include "selection/outliers.h"
#include "selection/readings.h"
#include "selection/search.h"

namespace rolling {
namespace {

/// The means of t and y over consecutive blocks of `size` samples, from those of the first sample
/// on, positions too; an incomplete last block is dropped.
std::vector<Sample> means(std::span<const Sample> run, std::size_t size, bool positions) {
  const Sample origin{run[0].t, positions ? run[0].y : 0};
  std::vector<Sample> blocks;
  for (std::size_t i = 0; i + size <= run.size(); i += size) {
    const Sample& begin = run[i];  // means of differences from it lose no digits
    double t = 0;
    double y = 0;
    for (const Sample& s : run.subspan(i, size)) {
      t += s.t - begin.t;
      y += s.y - begin.y;
    }
    blocks.push_back({begin.t - origin.t + t / static_cast<double>(size),
                      begin.y - origin.y + y / static_cast<double>(size)});
  }
  return blocks;
}

/// The roll in the means of so many samples each.
FreeRoll roll_in_means(std::span<const Sample> run, bool positions, std::size_t size) {
  constexpr double off = 6;  // standard errors
  std::vector<double> y;     // of the first sample of each mean
  for (std::size_t i = 0; i < run.size(); i += size) y.push_back(run[i].y);
  // Speeds that a sensor takes from rounded positions have errors that follow each other.
  double step = 0;
  if (positions) step = grid_of(y);
  else if (size > 1) step = 2 * grid_of(y) / static_cast<double>(size);
  const bool held = are_held(y);
  const std::vector<Sample> readings = means(run, size, positions);
  const Units units(readings);
  std::vector<Sample> samples;     // those that are on the motion of their neighbours
  std::vector<std::size_t> index;  // in the run, of their first
  Outliers outliers({201, 0}, off);
  std::size_t i = 0;
  const auto take = [&](std::span<const Sample> judged) {
    for (const Sample& s : judged) {
      while (readings[i].t < s.t) ++i;
      // The last reading is beyond its neighbours: a stop there looks like an outlier.
      if (std::isnan(s.y) && i + 1 < readings.size()) continue;
      samples.push_back(units(readings[i]));
      index.push_back(i * size);
    }
  };
  for (std::size_t k = 0; k < readings.size(); ++k)  // of held readings the first alone is one
    if (!held || k == 0 || k + 1 == readings.size() || readings[k].y != readings[k - 1].y)
      take(outliers.push(readings[k].t, readings[k].y));
  take(outliers.finish());
  const double noise = noise_of(samples, positions, std::ldexp(step, -units.y));
  const auto found = search_roll(samples, positions, noise);
  if (!found) {
    const auto [low, high] = std::ranges::minmax(y);
    fail(
        "no free roll is found: the readings go from {:.4g} to {:.4g}, and no motion in them that "
        "slows down stands out of their noise of {:.1g}: choose the roll by its times (--from, "
        "--to)",
        low, high, std::ldexp(noise, units.y));
  }
  FreeRoll roll = *found;
  const auto of_run = [&](const Stretch& s) {
    const std::size_t begin = index[s.begin];
    const std::size_t end = s.end == samples.size() ? run.size() : index[s.end - 1] + size;
    return Stretch{begin, end, run[begin].t, run[end - 1].t};
  };
  roll.kept = of_run(roll.kept);
  if (roll.other) roll.other = of_run(*roll.other);
  roll.after = std::ldexp(roll.after, units.t) + run[0].t;
  return roll;
}

}  // namespace

FreeRoll free_roll(std::span<const Sample> run, bool positions) {
  constexpr std::size_t at_once = 1000;
  const std::size_t n = run.size();
  const std::size_t size = (n + at_once - 1) / at_once;
  if (n < 10) fail("a run of {} rows is too short to find its free roll", n);
  FreeRoll roll = roll_in_means(run, positions, size);
  if (size == 1) return roll;
  // As much on either side as the roll is long shows its beginning and its end. If that is more
  // than half of the run, a second search would see little more.
  const std::size_t around = std::max(roll.kept.end - roll.kept.begin, 20 * size);
  const std::size_t from = roll.kept.begin - std::min(around, roll.kept.begin);
  const std::size_t to = std::min(roll.kept.end + around, n);
  if (to - from > n / 2) return roll;
  const auto other = roll.other;
  roll = free_roll(run.subspan(from, to - from), positions);
  roll.kept.begin += from;
  roll.kept.end += from;
  if (roll.how == FreeRoll::End::goes_on && to < n) roll.how = FreeRoll::End::is_ended;
  roll.other = other;
  return roll;
}

}  // namespace rolling
