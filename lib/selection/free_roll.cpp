// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/free_roll.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
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

/// As many means are searched at once, or readings.
constexpr std::size_t at_once = 1000;

std::size_t size_of_means(std::size_t n) { return (n + at_once - 1) / at_once; }

/// Refuses a run if more than this share of its readings are off the motion.
void refuse_spikes(std::span<const Sample> run, double share) {
  const Spikes spikes = spikes_in(run);
  if (static_cast<double>(spikes.found) <= share * static_cast<double>(spikes.among)) return;
  fail<MotionError>(
      "{} of {} readings jump off the motion and back, the first to {:.4g} at {:.12g} s: too many "
      "to "
      "find the free roll; a sensor without an echo often gives 0 or its largest reading: leave "
      "these rows out, or make the cells blank",
      spikes.found, spikes.among, spikes.first.y, spikes.first.t);
}

/// Refuses positions whose counter has started over.
void refuse_start_over(std::span<const Sample> run) {
  const auto over = start_over(run);
  if (!over) return;
  const Sample& before = run[*over - 1];
  const Sample& after = run[*over];
  fail<MotionError>(
      "the positions jump from {:.6g} to {:.6g} at {:.12g} s, and the motion goes on: a counter "
      "that starts over; add its range to all later rows",
      before.y, after.y, after.t);
}

/// The rolls in the means of equal numbers of samples, and the noise of these means.
std::pair<std::vector<FreeRoll>, double> rolls_in_means(std::span<const Sample> run,
                                                        bool positions) {
  const std::size_t size = size_of_means(run.size());
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
  const Means of_rows = means_of_rows(samples);
  const double noise =
      std::max(noise_of(samples, positions, std::ldexp(step, -units.y)), of_rows.noise);
  std::vector<FreeRoll> rolls = search_rolls(samples, positions, noise, of_rows.rows);
  const auto of_run = [&](const Stretch& s) {
    // The first position behind those that are off the motion may have been read amid the push.
    const bool behind_others = positions && s.begin == 0 && index[0] > 0;
    const std::size_t begin = index[s.begin + behind_others];
    const std::size_t end = s.end == samples.size() ? run.size() : index[s.end - 1] + size;
    return Stretch{begin, end, run[begin].t, run[end - 1].t};
  };
  for (FreeRoll& roll : rolls) {
    roll.kept = of_run(roll.kept);
    if (roll.other) roll.other = of_run(*roll.other);
    roll.after = std::ldexp(roll.after, units.t) + run[0].t;
    roll.speed = std::ldexp(roll.speed, units.y);
  }
  return {std::move(rolls), std::ldexp(noise, units.y)};
}

/// The samples that two stretches share, or less than 0.
std::ptrdiff_t shared(const Stretch& a, const Stretch& b) {
  return static_cast<std::ptrdiff_t>(std::min(a.end, b.end)) -
         static_cast<std::ptrdiff_t>(std::max(a.begin, b.begin));
}

/// Makes the indices of a stretch in a part of a run, which begins here, those in the whole run.
void shift(Stretch& s, std::size_t begin) {
  s.begin += begin;
  s.end += begin;
}

/// The same roll, sought again in the samples around it, whose means are finer.
void refine(std::span<const Sample> run, bool positions, FreeRoll& roll) {
  std::size_t n = run.size();
  while (size_of_means(n) > 1) {
    // As much on either side as the roll is long shows its beginning and its end. If that is more
    // than half of the run, a second search would see little more.
    const std::size_t around = std::max(roll.kept.end - roll.kept.begin, 20 * size_of_means(n));
    const std::size_t from = roll.kept.begin - std::min(around, roll.kept.begin);
    const std::size_t to = std::min(roll.kept.end + around, run.size());
    if (to - from > n / 2) return;
    n = to - from;
    std::vector<FreeRoll> found = rolls_in_means(run.subspan(from, n), positions).first;
    if (found.empty()) return;  // finer means are noisier
    for (FreeRoll& of : found) shift(of.kept, from);
    const auto in_common = [&](const FreeRoll& of) { return shared(of.kept, roll.kept); };
    const FreeRoll& same = *std::ranges::max_element(found, {}, in_common);
    if (in_common(same) <= 0) return;
    roll.kept = same.kept;
    roll.after = same.after;
    roll.how = same.how;
    roll.speed = same.speed;
    if (same.how == FreeRoll::End::goes_on && to < run.size()) roll.how = FreeRoll::End::is_ended;
  }
}

/// The rolls in parts of a run, each of which overlaps the next by a half, the longest first: those
/// that are too short for the means of the whole run. The search takes parts of half the size until
/// they show rolls and no new ones, or the samples themselves are searched, or there are 32.
std::vector<FreeRoll> rolls_in_parts(std::span<const Sample> run, bool positions) {
  std::vector<FreeRoll> rolls;
  const auto longer = [](const FreeRoll& a, const FreeRoll& b) {
    return a.kept.to - a.kept.from > b.kept.to - b.kept.from;
  };
  std::size_t size = run.size();
  bool done = false;
  for (std::size_t parts = 2; !done && size_of_means(size) > 1 && parts <= 32; parts *= 2) {
    const std::size_t before = rolls.size();
    size = 2 * run.size() / (parts + 1);
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t begin = part * (run.size() - size) / (parts - 1);
      for (FreeRoll& roll : rolls_in_means(run.subspan(begin, size), positions).first) {
        shift(roll.kept, begin);
        if (roll.other) shift(*roll.other, begin);
        if (roll.kept.end < run.size() && roll.how == FreeRoll::End::goes_on)
          roll.how = FreeRoll::End::is_ended;
        const auto same = [&](const FreeRoll& of) { return shared(of.kept, roll.kept) > 0; };
        const auto known = std::ranges::find_if(rolls, same);
        if (known == rolls.end()) rolls.push_back(roll);
        else if (longer(roll, *known)) *known = roll;
      }
    }
    done = before > 0 && rolls.size() == before;
  }
  std::ranges::sort(rolls, longer);
  return rolls;
}

/// The rolls in a run. Throws Error if there is none.
std::vector<FreeRoll> rolls_of(std::span<const Sample> run, bool positions) {
  if (run.size() < 10) fail("a run of {} rows is too short to find its free roll", run.size());
  refuse_spikes(run, 0.12);
  if (positions) refuse_start_over(run);
  auto [of_means, noise] = rolls_in_means(run, positions);
  std::vector<FreeRoll> rolls = std::move(of_means);
  if (rolls.empty()) rolls = rolls_in_parts(run, positions);
  if (!rolls.empty()) return rolls;
  refuse_spikes(run, 0.02);
  const auto [low, high] = std::ranges::minmax(run, {}, &Sample::y);
  fail<NoFreeRoll>(
      "no free roll is found: the readings go from {:.4g} to {:.4g}, and no slowing down is long "
      "enough, or above their noise of {:.1g}",
      low.y, high.y, noise);
}

}  // namespace

FreeRoll free_roll(std::span<const Sample> run, bool positions) {
  FreeRoll longest = rolls_of(run, positions).front();
  refine(run, positions, longest);
  return longest;
}

std::vector<FreeRoll> free_rolls(std::span<const Sample> run, bool positions) {
  std::vector<FreeRoll> rolls = rolls_of(run, positions);
  for (FreeRoll& roll : rolls) refine(run, positions, roll);
  std::ranges::sort(rolls, {}, [](const FreeRoll& roll) { return roll.kept.begin; });
  return rolls;
}

}  // namespace rolling
