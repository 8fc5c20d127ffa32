#include "signal/free_roll.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/median.h"
#include "base/rounding.h"
#include "signal/corner.h"
#include "signal/moving_median.h"
#include "signal/release.h"
#include "signal/units.h"

namespace rolling {
namespace {

/// The distance along the direction of motion: the positions themselves, or the integral of the
/// speeds by the trapezium rule.
std::vector<Sample> way_of(std::span<const Sample> run, bool positions, double sign) {
  std::vector<Sample> way(run.begin(), run.end());
  double x = 0;
  for (std::size_t i = 0; i < run.size(); ++i) {
    if (i > 0) x += (run[i].t - run[i - 1].t) * std::midpoint(run[i].y, run[i - 1].y);
    way[i].y = sign * (positions ? run[i].y : x);
  }
  return way;
}

/// The sums of a sliding window, which give its mean and its slope in O(1) per sample. Indices
/// count from the sample in the middle.
struct Sums {
  long double n = 0, i = 0, t = 0, y = 0, it = 0, iy = 0;

  void add(long double index, const Sample& s, long double sign) {
    n += sign, i += sign * index, t += sign * s.t, y += sign * s.y;
    it += sign * index * s.t, iy += sign * index * s.y;
  }
  void move_on() { i -= n, it -= t, iy -= y; }
  double mean() const { return static_cast<double>(y / n); }
  /// The slope of the line with the same first moments about the indices as the samples; at even
  /// times it is the least-squares slope.
  double slope() const { return static_cast<double>((iy - i / n * y) / (it - i / n * t)); }
};

/// The speeds of a run from windows of 2k + 1 samples, which are cut off at the ends of the run.
struct View {
  std::size_t k, peak = 0;
  std::vector<double> speeds;
  double fastest, noise;

  View(std::span<const Sample> run, bool positions, double step, std::size_t half) : k(half) {
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
    // Positions that only their rounding disturbs have errors that follow each other.
    const double window =
        (run[n - 1].t - run[0].t) / static_cast<double>(n - 1) * static_cast<double>(2 * k + 1);
    if (positions) noise = std::max(noise, step / window / 2);
  }

  /// The noise of the speeds, from second differences of windows that do not overlap, after sample
  /// `first` and at speeds of at least `least`; from the whole run if there are fewer than ten.
  double noise_from(std::size_t first, double least) const {
    const std::size_t apart = 2 * k + 1;
    std::vector<double> distances;
    for (std::size_t i = first + apart; i + apart < speeds.size(); ++i)
      if (std::abs(speeds[i]) >= least)
        distances.push_back(std::abs(speeds[i + apart] - 2 * speeds[i] + speeds[i - apart]));
    if (distances.size() < 10 && least > 0) return noise_from(0, 0);
    return deviation(distances) / std::sqrt(6.0);
  }
};

constexpr double enough = 0.02;  // noise relative to the greatest speed that is small enough

/// The narrowest windows whose noise is below 2 % of the greatest speed, if there are any;
/// otherwise those with the smallest relative noise.
View best_view(std::span<const Sample> run, bool positions, double step) {
  View view(run, positions, step, 2);
  for (std::size_t k = view.k; view.noise > enough * view.fastest;) {
    // The noise of slopes falls as the width to the power of -3/2; that of means falls more slowly.
    const double excess = std::pow(view.noise / (enough * view.fastest), 2.0 / 3);
    k = 1 + static_cast<std::size_t>(static_cast<double>(k) * std::clamp(excess, 1.25, 4.0));
    if (20 * k >= run.size()) break;
    if (View wider(run, positions, step, k);
        wider.noise * view.fastest < view.noise * wider.fastest)
      view = std::move(wider);
  }
  return view;
}

/// The smallest difference between neighbours above the rounding error of a program: the resolution
/// of the readings, if they are rounded.
double smallest_step(std::span<const Sample> readings) {
  double largest = 0, step = std::numeric_limits<double>::infinity();
  for (const Sample& s : readings) largest = std::max(largest, std::abs(s.y));
  for (std::size_t i = 1; i < readings.size(); ++i)
    if (const double here = std::abs(readings[i].y - readings[i - 1].y);
        here > program_rounding * largest)
      step = std::min(step, here);
  return step;
}

/// Replaces outliers by the moving median of five, so that one or two of them make no corner. An
/// outlier is further from the median than 6 standard deviations of these distances (for samples
/// from `first` on, while the body moves) and than 3 times `step`.
std::vector<Sample> without_spikes(std::span<const Sample> readings, std::size_t first,
                                   double step) {
  MovingMedian median_of_five({5, 0});
  std::vector<Sample> kept(readings.begin(), readings.end());
  const std::vector<double> medians =
      output_of(median_of_five, kept.size(), [&](std::size_t i) { return kept[i]; });
  std::vector<double> distances;
  for (std::size_t i = first; i < kept.size(); ++i)
    distances.push_back(std::abs(kept[i].y - medians[i]));
  const double most = std::max(6 * deviation(distances), 3 * step);
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (std::abs(kept[i].y - medians[i]) > most) kept[i].y = medians[i];
  return kept;
}

constexpr const char* not_found =
    "no free roll is found after the last push: choose it by its times (--from, --to)";

/// A run with the quantities that the search for its roll needs. `step` is the resolution of its
/// readings.
class Search {
 public:
  Search(std::span<const Sample> run, bool positions, double step)
      : positions_(positions), step_(step), view_(best_view(run, positions, step)),
        sign_(view_.speeds[view_.peak] < 0 ? -1 : 1) {
    if (!(view_.fastest > 8 * view_.noise))
      fail(
          "no motion stands out of the noise, or too few records show it: if there is a free roll, "
          "choose it by its times (--from, --to)");
    const auto moves = [&](std::size_t i) { return speed(i) > 2 * view_.noise; };
    first_ = end_ = view_.peak;
    while (first_ > 0 && moves(first_ - 1)) --first_;
    while (end_ < run.size() && moves(end_)) ++end_;
    if (end_ < run.size()) {
      end_ = std::min(end_ + 2 * view_.k + 1, run.size());
      while (!moves(end_ - 1)) --end_;
      end_ -= std::min(view_.k + 1, end_);
    }
    if (end_ < least_samples) fail("{}", not_found);
    samples_ = without_spikes(run.subspan(0, end_), first_, step);
  }
  std::size_t end() const { return end_; }

  /// The beginning of the roll according to corners of this significance; end() if there is none.
  std::size_t begin(double significance) const {
    const std::size_t corner = corner_of(significance);
    auto [from, to] = slowing_after(corner);
    if (to < from + least_samples) return end_;
    Release release = release_in(from, to);
    if (corner == 0 && !(release.significance >= significance)) return 0;
    // The speed of a roll is not a linear function of time. If the release is known to an eighth of
    // the fitted samples behind it, half of these suffice; the curvature then matters a quarter as
    // much.
    while (8 * (release.latest - release.earliest) < to - release.latest &&
           to - release.latest > 2 * least_samples) {
      to = std::midpoint(release.latest, to);
      from = std::midpoint(from, release.earliest);
      release = release_in(from, to);
    }
    return std::min(release.latest + 3, end_);
  }

 private:
  static constexpr std::size_t least_samples = 8;

  Release release_in(std::size_t from, std::size_t to) const {
    Release release = release_of(std::span(samples_).subspan(from, to - from), positions_, sign_);
    release.earliest += from, release.latest += from;
    return release;
  }
  double speed(std::size_t i) const { return sign_ * view_.speeds[i]; }

  std::size_t corner_of(double significance) const {
    constexpr double least = 0.05;  // relative to the greatest speed
    const double dt = (samples_[end_ - 1].t - samples_[0].t) / static_cast<double>(end_ - 1);
    // The rounding error of a reading has the standard deviation step / sqrt(12). The bend in
    // corner.cpp has sqrt(6) times that for positions, and twice that for means of white speeds.
    // The errors of positions follow each other where a reading moves by less than a step: means do
    // not reduce them. Speeds that a sensor computed from four positions are twice as noisy as
    // their step suggests.
    const RoundedSpeeds coarse = positions_ ? RoundedSpeeds{step_ / std::sqrt(2) / dt, 1}
                                            : RoundedSpeeds{4 * step_ / std::sqrt(12), 0.5};
    std::size_t size = 1;  // smaller blocks than those of the view contain only noise
    while (4 * size <= view_.k) size *= 2;
    return last_corner(way_of(samples_, positions_, sign_),
                       {size, first_, least * view_.fastest, significance, coarse});
  }

  /// The range of samples around the release: the speed is above 0.9 of its maximum after the
  /// corner, and the range ends where it falls to 0.75 of that. Within it the deceleration changes
  /// little.
  std::pair<std::size_t, std::size_t> slowing_after(std::size_t corner) const {
    std::size_t peak = corner;
    for (std::size_t i = corner; i < end_; ++i)
      if (speed(i) > speed(peak)) peak = i;
    const auto last_above = [&](double share) {
      std::size_t last = end_;
      while (last > peak + 1 && speed(last - 1) < share * speed(peak)) --last;
      return last;
    };
    const std::size_t to = std::min(std::max(last_above(0.75), peak + least_samples), end_),
                      slow = 6 * (to - std::min(last_above(0.9), to));
    std::size_t from = peak;
    while (from > first_ && from + slow > to && speed(from - 1) > 0.9 * speed(peak)) --from;
    return {from, to};
  }

  bool positions_;
  double step_;
  View view_;
  double sign_;
  std::size_t first_, end_;
  std::vector<Sample> samples_;  // from the beginning of the run to the end of the roll
};

/// The most samples of one search, which then costs less than reading a longer run.
constexpr std::size_t at_once = 20000;

/// The roll in a run of at most at_once samples.
Stretch roll_of(std::span<const Sample> readings, bool positions, double step) {
  constexpr double clear = 5, faint = 3.5;  // standard deviations
  const Units units(readings);
  std::vector<Sample> run(readings.size());
  std::ranges::transform(readings, run.begin(), units);
  const Search search(run, positions, std::ldexp(step, -units.y));
  Stretch roll{search.begin(clear), search.end(), {}};
  if (roll.begin + 3 > roll.end) fail("{}", not_found);
  const std::size_t other = std::min(search.begin(faint), roll.end - 1);
  const std::size_t apart = other > roll.begin ? other - roll.begin : roll.begin - other;
  if (10 * apart > roll.end - roll.begin) roll.other = other;
  return roll;
}

}  // namespace

Stretch free_roll(std::span<const Sample> run, bool positions) {
  if (run.size() < 10) fail("a run of {} records is too short to find its free roll", run.size());
  if (run.size() <= at_once) return roll_of(run, positions, smallest_step(run));
  const std::size_t size = 2 * run.size() / at_once, n = run.size();
  // The rounding errors of speeds are independent, those of positions follow each other.
  const double step = smallest_step(run),
               step_of_means = positions ? step : step / std::sqrt(static_cast<double>(size));
  Stretch roll = roll_of(means(run, size), positions, step_of_means);
  roll.begin *= size, roll.end = std::min(roll.end * size, n);
  if (roll.other) *roll.other *= size;
  // A range as long as the roll on either side shows its beginning and its end. If that is more
  // than half of the run, the second search would have nearly the same resolution.
  const std::size_t around = std::max(roll.end - roll.begin, 20 * size),
                    from = roll.begin - std::min(around, roll.begin),
                    to = std::min(roll.end + around, n);
  if (to - from > n / 2) return roll;
  Stretch finer = free_roll(run.subspan(from, to - from), positions);
  finer.begin += from, finer.end += from;
  if (finer.other) *finer.other += from;
  return finer;
}

}  // namespace rolling
