#include "signal/free_roll.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/median.h"
#include "signal/derivative.h"
#include "signal/moving_median.h"

namespace rolling {
namespace {

/// The standard deviation of normal numbers with outliers: their distances from 0 are less than it
/// in 68.27 % of cases. Steps of rounded readings, of which most are 0, do not make it 0 as early
/// as they do the median. Puts the distances into another order.
double deviation(std::span<double> distances) {
  if (distances.empty()) return {};
  const auto count = static_cast<double>(distances.size());
  return nth_smallest(distances, static_cast<std::size_t>(0.6827 * count));
}

std::vector<Sample> speeds_of(std::span<const Sample> run, bool positions) {
  std::vector<Sample> speeds(run.begin(), run.end());
  if (!positions) return speeds;
  CentralDerivative derivative;
  auto next = speeds.begin();
  const auto take = [&](std::span<const double> slopes) {
    for (const double slope : slopes) (next++)->y = slope;
  };
  for (const Sample& s : run) take(derivative.push(s.t, s.y));
  take(derivative.finish());
  return speeds;
}

/// The sums of a sliding window, by which it has a mean and a slope: O(1) a sample. Indices count
/// from the sample in the middle.
struct Sums {
  long double n = 0, i = 0, t = 0, y = 0, it = 0, iy = 0;

  void add(long double index, const Sample& s, long double sign) {
    n += sign, i += sign * index, t += sign * s.t, y += sign * s.y;
    it += sign * index * s.t, iy += sign * index * s.y;
  }
  void move_on() { i -= n, it -= t, iy -= y; }
  double mean() const { return static_cast<double>(y / n); }
  /// Of the line with the same moments about the indices; on even times that of least squares.
  double slope() const { return static_cast<double>((iy - i / n * y) / (it - i / n * t)); }
};

/// The speeds of a run, seen through windows of 2k + 1 samples, cut off at the ends of the run.
struct View {
  std::size_t k, peak = 0;
  std::vector<double> speeds;
  double fastest, noise;

  View(std::span<const Sample> run, bool positions, std::size_t half) : k(half) {
    const std::size_t n = run.size();
    const auto from_first = [&](std::size_t j) { return Sample{run[j].t - run[0].t, run[j].y}; };
    speeds.reserve(n);
    Sums sums;
    const auto index = [](std::size_t j, std::size_t i) {
      return static_cast<long double>(j) - static_cast<long double>(i);
    };
    for (std::size_t i = 0, from = 0, to = 0; i < n; sums.move_on(), ++i) {
      for (; to < std::min(i + k + 1, n); ++to) sums.add(index(to, i), from_first(to), 1);
      for (; from + k < i; ++from) sums.add(index(from, i), from_first(from), -1);
      speeds.push_back(positions ? sums.slope() : sums.mean());
      if (std::abs(speeds[i]) > std::abs(speeds[peak])) peak = i;
    }
    fastest = std::abs(speeds[peak]);
    noise = noise_from(peak, fastest / 5);
  }

  /// From the second differences of windows that do not overlap, after a sample and while the body
  /// moves at least so fast; of the whole run where these are too few.
  double noise_from(std::size_t first, double least) const {
    const std::size_t apart = 2 * k + 1, every = 1 + speeds.size() / 100000;
    std::vector<double> distances;
    for (std::size_t i = first + apart; i + apart < speeds.size(); i += every)
      if (std::abs(speeds[i]) >= least)
        distances.push_back(std::abs(speeds[i + apart] - 2 * speeds[i] + speeds[i - apart]));
    if (distances.size() < 10 && least > 0) return noise_from(0, 0);
    return deviation(distances) / std::sqrt(6.0);
  }
};

constexpr double enough = 0.02;  // of the greatest speed: what is less does not matter

/// The narrowest windows that show the greatest speed to 2 %, if there are such.
View best_view(std::span<const Sample> run, bool positions) {
  View view(run, positions, 2);
  for (std::size_t k = view.k; view.noise > enough * view.fastest;) {
    // The noise of slopes falls with the width to the power of 3/2, that of means more slowly.
    const double excess = std::pow(view.noise / (enough * view.fastest), 2.0 / 3);
    k = 1 + static_cast<std::size_t>(static_cast<double>(k) * std::clamp(excess, 1.25, 4.0));
    if (20 * k >= run.size()) break;
    if (View wider(run, positions, k); wider.noise * view.fastest < view.noise * wider.fastest)
      view = std::move(wider);
  }
  return view;
}

constexpr std::size_t corner_window = 4;
constexpr double least_corner = 0.05;  // speed that a push adds in a window, of the greatest

/// The least-squares line through corner_window samples: how much it rises from window to window.
double rise(std::span<const Sample> window, double duration) {
  double t = 0, y = 0, tt = 0, ty = 0;
  for (const Sample& s : window) t += s.t - window[0].t, y += s.y;
  t /= corner_window, y /= corner_window;
  for (const Sample& s : window) {
    const double from = s.t - window[0].t - t;
    tt += from * from, ty += from * (s.y - y);
  }
  return ty / tt * duration;
}

/// One or two speeds that do not belong make no corner: the median of five takes the place of
/// those that are further from it than 6 standard deviations of such distances while the body
/// moves, from `first` on.
std::vector<Sample> without_spikes(std::vector<Sample> speeds, std::size_t first) {
  MovingMedian median_of_five({5, 0});
  std::vector<double> medians, distances;
  medians.reserve(speeds.size());
  const auto take = [&](std::span<const double> values) {
    medians.insert(medians.end(), values.begin(), values.end());
  };
  for (const Sample& s : speeds) take(median_of_five.push(s.t, s.y));
  take(median_of_five.finish());
  const std::size_t every = 1 + speeds.size() / 100000;
  for (std::size_t i = first; i < speeds.size(); i += every)
    distances.push_back(std::abs(speeds[i].y - medians[i]));
  const double most = 6 * deviation(distances);
  for (std::size_t i = 0; i < speeds.size(); ++i)
    if (std::abs(speeds[i].y - medians[i]) > most) speeds[i].y = medians[i];
  return speeds;
}

/// Where a corner is sharpest, and where it is last seen, as indices; 0 if there is none.
struct Corner {
  std::size_t at = 0, last = 0;
};

/// The last corner of speeds, at `first` or later, of more than `least`.
Corner last_corner(std::span<const Sample> speeds, std::size_t first, double least) {
  constexpr std::size_t w = corner_window;
  constexpr double standing_out = 5, less_than = 0.5;
  std::vector<double> bends;  // from index w on, as speeds that were gained in one window
  bends.reserve(speeds.size());
  for (std::size_t i = w; i + w <= speeds.size(); ++i) {
    const double duration = (speeds[i + w - 1].t - speeds[i - w].t) * w / (2 * w - 1);
    bends.push_back(rise(speeds.subspan(i - w, w), duration) -
                    less_than * rise(speeds.subspan(i, w), duration));
  }
  if (bends.empty()) return {};

  const std::size_t every = 1 + bends.size() / 100000;
  std::vector<double> noise, distances;
  for (std::size_t i = std::max<std::size_t>(first, 1); i + 1 < speeds.size(); i += every)
    noise.push_back(std::abs(speeds[i + 1].y - 2 * speeds[i].y + speeds[i - 1].y));
  for (std::size_t i = std::max(first, w); i - w < bends.size(); i += every)
    distances.push_back(bends[i - w]);
  if (distances.empty()) return {};
  // Of white noise of the speeds, second differences have sqrt(6) times as much, lines through w of
  // them rise by sqrt(12 w / (w^2 - 1)) times as much from window to window.
  double sigma = deviation(noise) / std::sqrt(6.0) *
                 std::sqrt(12.0 * w / (w * w - 1) * (1 + less_than * less_than));
  if (distances.size() >= 20) {  // enough to ask them themselves: noise need not be white
    const double middle = median(distances);
    for (double& bend : distances) bend = std::abs(bend - middle);
    sigma = std::max(sigma, 1.4826 * median(distances));
  }
  const auto seen = [&](std::size_t i) { return bends[i] > std::max(least, standing_out * sigma); };
  std::size_t last = bends.size();
  while (last > 0 && last + w > first && !seen(last - 1)) --last;
  if (last == 0 || last + w <= first) return {};
  std::size_t at = last - 1;
  for (std::size_t i = last; i-- > 0 && seen(i);)
    if (bends[i] > bends[at]) at = i;
  return {at + w, last - 1 + w};
}

/// The last corner of speeds > 0, of which the moving ones begin at `first`; 0 if there is none.
std::size_t last_corner_at_any_scale(std::vector<Sample> speeds, std::size_t first, double least) {
  std::size_t corner = 0, clear = 0;  // windows that begin at `clear` do not know of it
  for (std::size_t size = 1; speeds.size() > 2 * corner_window; size *= 2) {
    const std::size_t from = std::min((clear + size - 1) / size, speeds.size());
    const Corner found = last_corner(std::span<const Sample>(speeds).subspan(from),
                                     std::max(first / size, from) - from, least);
    if (found.at > 0) {
      corner = (from + found.at) * size;
      clear = (from + found.last + corner_window / 2) * size;
    }
    for (std::size_t i = 0; i < speeds.size() / 2; ++i) {
      const Sample &a = speeds[2 * i], &b = speeds[2 * i + 1];
      speeds[i] = {std::midpoint(a.t, b.t), std::midpoint(a.y, b.y)};
    }
    speeds.resize(speeds.size() / 2);
  }
  return corner;
}

}  // namespace

Stretch free_roll(std::span<const Sample> run, bool positions) {
  const std::size_t n = run.size();
  if (n < 10) fail("a run of {} records is too short to find its free roll", n);
  std::vector<Sample> speeds = speeds_of(run, positions);
  const View view = best_view(run, positions);
  if (!(view.fastest > 8 * view.noise)) fail("nothing moves in this run: it has no free roll");

  const double sign = view.speeds[view.peak] < 0 ? -1 : 1;
  const auto moves = [&](std::size_t i) { return sign * view.speeds[i] > 2 * view.noise; };
  std::size_t first = view.peak, end = view.peak;
  while (first > 0 && moves(first - 1)) --first;
  while (end < n && moves(end)) ++end;
  if (end < n) end -= std::min(view.k, end);
  speeds.resize(end);
  for (Sample& s : speeds) s.y *= sign;
  while (!positions && !speeds.empty() && speeds.back().y <= 0) speeds.pop_back();
  end = speeds.size();
  std::size_t begin =
      last_corner_at_any_scale(without_spikes(speeds, first), first, least_corner * view.fastest);
  if (begin > 0) {
    const auto speed = [&](std::size_t i) { return sign * view.speeds[i]; };
    std::size_t release = begin;
    for (std::size_t i = begin; i < end; ++i)
      if (speed(i) > speed(release)) release = i;
    const double fastest = speed(release);
    for (std::size_t i = release; i < end && speed(i) > 0.9 * fastest; ++i)
      if (speed(i) > fastest - view.noise) release = i;
    begin = release + view.k + 3;
  }
  if (begin + 3 > end)
    fail("no free roll is found after the last push: choose it by its times (--from, --to)");
  return {begin, end};
}

}  // namespace rolling
