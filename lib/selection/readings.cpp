// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/readings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "base/grid.h"
#include "base/matrix.h"
#include "base/median.h"
#include "selection/polynomial.h"

namespace rolling {
namespace {

/// The last written place of the readings; an upper bound if grid_of() does not find it.
double place_of(std::span<const double> readings) {
  const auto [least, most] = std::ranges::minmax(readings);
  return std::max(grid_of(readings), finest_grid * std::max(std::abs(least), std::abs(most)));
}

/// The way that all rows allow, each by the rounding of its numbers. `row`: 1 where the speed of a
/// row is that since the row before, 0 where it is that to the next.
std::optional<double> way_by(std::span<const double> t, std::span<const double> v,
                             std::size_t row) {
  std::vector<double> since_first(t.begin(), t.end());
  for (double& time : since_first) time -= t[0];
  const double of_clock =
      std::numeric_limits<double>::epsilon() * (std::abs(t.front()) + std::abs(t.back()));
  const double of_t = place_of(since_first) + of_clock;
  const double of_v = place_of(v);
  double least = -INFINITY;
  double most = INFINITY;
  double coarsest = 0;
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    const double step = t[i + 1] - t[i];
    const double speed = v[i + row];
    const double rounding = std::abs(speed) * of_t + step * of_v / 2;
    if (std::isnan(speed)) return {};
    steps.push_back(step);
    coarsest = std::max(coarsest, rounding);
    least = std::max(least, speed * step - rounding);
    most = std::min(most, speed * step + rounding);
  }
  const double way = std::midpoint(least, most);
  const auto [shortest, longest] = std::ranges::minmax(steps);
  return least <= most && coarsest < 0.05 * std::abs(way) && longest > 1.3 * shortest
             ? std::optional(way)
             : std::nullopt;
}

/// The third differences of readings `lag` rows apart; 0 where a row between them is missing.
std::vector<double> third_differences(std::span<const Sample> samples, std::size_t lag) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < samples.size(); ++i) steps.push_back(samples[i].t - samples[i - 1].t);
  const double even = 3 * static_cast<double>(lag) * (steps.empty() ? 0 : median(steps));
  std::vector<double> third;
  for (std::size_t i = 0; i + 3 * lag < samples.size(); ++i) {
    const auto at = [&](std::size_t k) { return samples[i + k * lag]; };
    const bool missing = std::abs(at(3).t - at(0).t - even) > 0.03 * even;
    third.push_back(missing ? 0 : at(3).y - at(0).y - 3 * (at(2).y - at(1).y));
  }
  return third;
}

/// The sizes of those that are not 0, as they are at rest, or by rounding.
std::vector<double> sizes_of(std::span<const double> differences) {
  double largest = 0;
  for (const double d : differences) largest = std::max(largest, std::abs(d));
  std::vector<double> sizes;
  for (const double d : differences)
    if (std::abs(d) > finest_grid * largest) sizes.push_back(std::abs(d));
  return sizes;
}

/// The autocovariance of the third differences of what a filter with these weights makes of white
/// noise, in units of the variance that it makes.
std::vector<double> covariance_of(std::span<const double> weights, std::size_t lags) {
  constexpr std::array third{-1.0, 3.0, -3.0, 1.0};
  std::vector<double> of_third(weights.size() + third.size() - 1);
  for (std::size_t i = 0; i < weights.size(); ++i)
    for (std::size_t k = 0; k < third.size(); ++k) of_third[i + k] += weights[i] * third[k];
  const double variance = dot(weights, weights);
  std::vector<double> covariance(lags);
  for (std::size_t lag = 0; lag < std::min(lags, of_third.size()); ++lag) {
    const std::span<const double> all(of_third);
    covariance[lag] = dot(all.first(all.size() - lag), all.subspan(lag)) / variance;
  }
  return covariance;
}

/// The weights of sensors that are no means: the readings themselves; speeds by differences over
/// two steps, and those of PASCO's and Vernier's programs (signal/derivative.h).
const std::vector<std::vector<double>> no_means{
    {1}, {-1, 0, 1}, {-1, -1, 0, 1, 1}, {-1. / 6, -1. / 2, -3. / 2, 0, 3. / 2, 1. / 2, 1. / 6}};

}  // namespace

double noise_of(std::span<const Sample> samples, bool positions, double step) {
  constexpr double least = 1e-6;  // of the range of readings: what no sensor resolves
  double noise = std::max(least, positions ? step / std::sqrt(12) : step);
  for (const auto& [size, typical] :
       {std::pair<std::size_t, double>{4, 0.6745}, {9, 0.94}, {25, 0.98}}) {
    std::vector<std::pair<double, double>> found;  // speed, scatter
    std::vector<double> speeds;
    std::vector<double> scatter;
    std::vector<double> all;
    for (std::size_t i = 0; i + size <= samples.size(); ++i) {
      const auto near = samples.subspan(i, size);
      Polynomial<3> fit;
      for (const Sample& s : near) fit.add(s.t - near[0].t, s.y);
      const double own = std::sqrt(fit.rss() / static_cast<double>(size - 3));
      const double moved = std::abs(positions ? near.back().y - near[0].y : near[size / 2].y);
      all.push_back(own);
      if (own > 0.12 * moved) continue;  // a jump or rest
      const bool coarse = positions && moved < 0.99 * step * static_cast<double>(size - 1);
      found.push_back({positions ? moved / (near.back().t - near[0].t) : moved,
                       std::max(own / typical, coarse ? 0.43 * step : 0)});
      speeds.push_back(found.back().first);
    }
    // A quarter of all tells the noise of a run in which nothing moves.
    if (size == 4 && !all.empty())
      noise = std::max(noise, nth_smallest(all, all.size() / 4) / 0.32);
    if (found.size() < (size == 4 ? 1 : 4 * size)) continue;
    const double fast = nth_smallest(speeds, speeds.size() - 1 - speeds.size() / 50);
    for (const auto& [speed, here] : found)
      if (speed >= 0.2 * fast) scatter.push_back(here);
    noise =
        std::max(noise, size == 25 ? nth_smallest(scatter, scatter.size() / 4) : median(scatter));
  }
  return noise;
}

Means means_of_rows(std::span<const Sample> samples) {
  constexpr std::size_t longest = 35;
  constexpr double clear = 50;  // as chi square
  constexpr double normal = 0.6745;
  std::vector<double> third = third_differences(samples, 1);
  std::vector<double> sizes = sizes_of(third);
  std::vector<double> apart = sizes_of(third_differences(samples, 3));
  if (std::min(sizes.size(), apart.size()) < 20) return {};
  const double typical = median(sizes);
  const bool rounded = typical < 3 * std::ranges::min(sizes);
  if (rounded || median(apart) < 1.3 * typical) return {};
  for (double& d : third) d = std::clamp(d, -2.5 * typical / normal, 2.5 * typical / normal);
  std::vector<double> seen;
  for (std::size_t lag = 0; lag < std::min(longest + 4, third.size()); ++lag) {
    const auto later = third.begin() + static_cast<std::ptrdiff_t>(lag);
    seen.push_back(std::inner_product(later, third.end(), third.begin(), 0.0));
  }
  const auto distance = [&](std::span<const double> weights) {
    const std::vector<double> expected = covariance_of(weights, seen.size());
    double sum = 0;
    for (std::size_t lag = 1; lag < seen.size(); ++lag)
      sum += std::pow(seen[lag] / seen[0] - expected[lag] / expected[0], 2);
    return static_cast<double>(sizes.size()) * sum;
  };
  double nearest = INFINITY;
  for (const std::vector<double>& weights : no_means)
    nearest = std::min(nearest, distance(weights));
  std::pair<double, std::size_t> best{nearest - clear, 1};
  for (std::size_t rows = 3; rows <= std::min(longest, samples.size() / 10); ++rows)
    best = std::min(best, {distance(std::vector<double>(rows, 1)), rows});
  const std::size_t rows = best.second;
  if (rows == 1) return {};
  const double of_mean = covariance_of(std::vector<double>(rows, 1), 1).front();
  const double variance = typical * typical / (normal * normal) / of_mean;
  return {rows, std::sqrt(static_cast<double>(rows) * variance)};
}

Spikes spikes_in(std::span<const Sample> run) {
  constexpr std::size_t beside = 5;
  std::vector<double> medians;
  std::vector<double> scatters;
  std::vector<Sample> apart;
  std::vector<double> readings;
  for (const Sample& s : run) readings.push_back(s.y);
  const double grid = grid_of(readings);
  const std::size_t step = 1 + run.size() / 2000;
  for (std::size_t i = beside; i + beside < run.size(); i += step) {
    std::vector<double> near;
    for (const Sample& s : run.subspan(i - beside, 2 * beside + 1)) near.push_back(s.y);
    medians.push_back(median(near));
    for (double& y : near) y = std::abs(y - medians.back());
    scatters.push_back(median(near));
    if (std::abs(run[i].y - medians.back()) > std::max(6 * scatters.back(), 3 * grid))
      apart.push_back(run[i]);
    else apart.push_back({run[i].t, medians.back()});
  }
  Spikes spikes{0, apart.size()};
  if (apart.empty()) return spikes;
  const auto [least, most] = std::ranges::minmax(medians);
  const double far = std::max((most - least) / 5, 8 * median(scatters));
  for (std::size_t i = 0; i < apart.size(); ++i)
    if (std::abs(apart[i].y - medians[i]) > far && spikes.found++ == 0) spikes.first = apart[i];
  return spikes;
}

std::optional<std::size_t> start_over(std::span<const Sample> run) {
  const auto [least, most] = std::ranges::minmax(run, {}, &Sample::y);
  for (std::size_t i = 2; i + 1 < run.size(); ++i) {
    const double jump = run[i].y - run[i - 1].y;
    const double before = run[i - 1].y - run[i - 2].y;
    const double after = run[i + 1].y - run[i].y;
    const double later = run[std::min(i + 10, run.size() - 1)].y - run[i - 1].y;
    const bool goes_on = before * after > 0 && before * jump < 0 && later / jump > 0.5;
    if (std::abs(jump) > 0.9 * (most.y - least.y) && goes_on &&
        std::max(std::abs(before), std::abs(after)) < 0.1 * std::abs(jump))
      return i;
  }
  return {};
}

namespace {

/// Whether each reading, but for the first and the last, stays for a whole multiple of two rows or
/// more, though some of the steps are larger than `unit`: rounded readings do not rest between such
/// steps.
bool stay_for_whole_holds(std::span<const double> readings, double rounding, double unit) {
  std::size_t rows = 1;
  std::size_t stretches = 0;
  std::size_t large = 0;
  std::size_t hold = 0;
  for (std::size_t i = 1; i < readings.size(); ++i, ++rows) {
    const double step = std::abs(readings[i] - readings[i - 1]);
    if (step <= rounding) continue;
    if (stretches > 0) hold = std::gcd(hold, rows);
    ++stretches;
    large += step > 1.5 * unit;
    rows = 0;
  }
  return hold > 1 && stretches > 8 && large > 3;
}

}  // namespace

bool are_held(std::span<const double> readings) {
  double largest = 0;
  for (const double y : readings) largest = std::max(largest, std::abs(y));
  const double rounding = program_rounding * largest;
  const auto step = [&](std::size_t i) { return std::abs(readings[i] - readings[i - 1]); };
  std::vector<double> steps;  // other than 0
  for (std::size_t i = 1; i < readings.size(); ++i)
    if (step(i) > rounding) steps.push_back(step(i));
  if (steps.empty() || 4 * steps.size() >= 3 * readings.size()) return false;
  const double low = nth_smallest(steps, steps.size() / 4);
  const double place = grid_of(readings) + rounding;
  const auto multiples = std::ranges::count_if(steps, [&](double of) {
    return std::abs(of - std::round(of / low) * low) <= std::max(0.02 * low, place);
  });
  const bool on_grid = 5 * static_cast<std::size_t>(multiples) >= 3 * steps.size();
  const double unit = on_grid ? low : std::min(low, 8 * place);
  if (stay_for_whole_holds(readings, rounding, unit)) return true;
  std::size_t waiting = 0;
  std::size_t held = 0;
  std::size_t stretches = 0;  // held between two jumps
  bool after_jump = false;
  for (std::size_t i = 1; i < readings.size(); ++i) {
    if (step(i) <= rounding) {
      waiting += readings[i] != 0;
      continue;
    }
    const bool jump = step(i) > 2.5 * unit;
    if (jump && after_jump) {
      held += waiting;
      ++stretches;
    }
    after_jump = jump;
    waiting = 0;
  }
  if (3 * held <= stretches) return false;
  // In each stretch one step is not 0. Chernoff's bound for so large a share of zeros by chance.
  const double zero = std::min(unit / (2 * median(steps)), 0.5);
  const auto n = static_cast<double>(held + stretches);
  const double share = static_cast<double>(held) / n;
  const double distance =
      share * std::log(share / zero) + (1 - share) * std::log((1 - share) / (1 - zero));
  return share > zero && std::exp(-n * distance) <= 0.01;
}

std::optional<double> way_between_pulses(std::span<const double> t, std::span<const double> v) {
  if (t.size() < 5 || v.size() != t.size()) return {};
  const auto since = way_by(t, v, 1);
  return since ? since : way_by(t, v, 0);
}

std::optional<RoundedTimes> rounded_times(std::span<const double> t) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  if (steps.empty()) return {};
  const double usual = median(steps);
  const double place = grid_of(t);
  if (place < usual / 20 || place > 0.6 * usual) return {};
  const auto is_off = [&](double step) {
    return std::abs(std::abs(step - usual) / place - 1) < 0.1;
  };
  if (10 * std::ranges::count_if(steps, is_off) < std::ssize(steps)) return {};
  std::erase_if(steps, [&](double step) { return step > usual + 1.5 * place; });
  const double all = std::accumulate(steps.begin(), steps.end(), 0.0);
  return RoundedTimes{place, all / static_cast<double>(steps.size())};
}

double ways_ratio(std::span<const double> t, std::span<const double> x, std::span<const double> v) {
  std::vector<double> by_x{0};
  std::vector<double> by_v{0};
  for (std::size_t i = 1; i < t.size(); ++i) {
    const double of_x = x[i] - x[i - 1];
    const double of_v = (v[i] + v[i - 1]) / 2 * (t[i] - t[i - 1]);
    if (!std::isfinite(of_x) || !std::isfinite(of_v)) continue;
    by_x.push_back(by_x.back() + of_x);
    by_v.push_back(by_v.back() + of_v);
  }
  if (by_x.size() < 10) return NAN;
  const std::size_t half = by_x.size() / 2;
  std::vector<double> ratios;
  for (std::size_t i = half; i < by_x.size(); ++i) {
    const double ratio = std::abs((by_x[i] - by_x[i - half]) / (by_v[i] - by_v[i - half]));
    if (!std::isnan(ratio)) ratios.push_back(ratio);  // as at rest
  }
  return ratios.empty() ? NAN : median(ratios);
}

}  // namespace rolling
