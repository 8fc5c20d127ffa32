// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/outliers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/grid.h"
#include "selection/polynomial.h"

namespace rolling {
namespace {

/// The samples that show the local motion: the one in question and its neighbours; at the ends of a
/// run, where the parabola goes beyond its samples, it needs more of them.
constexpr std::size_t nearby = 11;
constexpr std::size_t near_end = 26;

/// The lower quartile of the scatter of `nearby` normal readings about their parabola, in units of
/// their standard deviation: the root of that of chi square with 8 degrees of freedom, over 8.
constexpr double quartile = 0.79;

/// The median scatter of n normal readings about their parabola when the three worst are left out,
/// to 0.02. It was found in 600 simulated windows for each of five n from 10 to 25.
double of_best(std::size_t n) { return std::max(0.346, 1 - 6.5 / static_cast<double>(n)); }

/// Readings scatter if they do so by this many standard deviations; of eleven normal ones, one set
/// in 200 does.
constexpr double scatters = 1.7;

Width at_least_151(Width width) {
  constexpr std::size_t least = 151;
  width.least = least;
  if (width.seconds == 0) width.samples = std::max(width.samples, least);
  return width;
}

/// The neighbours of a sample in units in which they and their times are of order one.
struct Neighbours {
  std::size_t size = 0;
  std::array<Sample, near_end> at;

  double unit = 0, length = 0;

  /// Those of `origin`, but for this one.
  Neighbours(auto begin, auto end, const Sample& origin, const Sample* without) {
    for (auto s = begin; s != end; ++s) unit = std::max(unit, std::abs(s->y - origin.y));
    unit = unit > 0 ? std::ldexp(1.0, std::ilogb(unit)) : 1;
    length = (end - 1)->t - begin->t;
    for (auto s = begin; s != end; ++s)
      if (&*s != without) at[size++] = {(s->t - origin.t) / length, (s->y - origin.y) / unit};
  }
  /// The scatter about a polynomial of them.
  double scatter(const Polynomial<3>& motion) const {
    return std::sqrt(motion.rss() / static_cast<double>(motion.size() - 3));
  }
  /// Through those that lie within `most` of another parabola, as all do that it was fitted to:
  /// none of n is further off than the root of n - 3 of their scatter.
  Polynomial<3> parabola(const Polynomial<3>& other = {}, double most = INFINITY) const {
    Polynomial<3> fit;
    for (std::size_t i = 0; i < size; ++i)
      if (most == INFINITY || std::abs(at[i].y - other.derivative(0, at[i].t).value) <= most)
        fit.add(at[i].t, at[i].y);
    return fit;
  }
  /// Through all but three, or fewer if there are hardly more.
  Polynomial<3> best_parabola() const {
    const std::size_t all = size - std::min<std::size_t>(size > 4 ? size - 4 : 0, 3);
    Polynomial<3> best;
    Polynomial<3> none;
    const auto without = [&](auto& self, const Polynomial<3>& fit, std::size_t i) -> void {
      if (best.size() > 0 && fit.rss() >= best.rss()) return;
      if (fit.size() == all) return void(best = fit);
      if (fit.size() + size - i > all) self(self, fit, i + 1);
      Polynomial<3> with = fit;
      with.add(at[i].t, at[i].y);
      self(self, with, i + 1);
    };
    without(without, none, 0);
    return best;
  }
};

}  // namespace

Outliers::Outliers(Width width, double threshold)
    : near_({nearby, 0}, Windows::Ends::stay), scatter_(at_least_151(width), Windows::Ends::cut),
      threshold_(threshold) {}

std::span<const Sample> Outliers::push(double t, double y) {
  judged_.clear();
  if (count_++ > 0) large_ = std::max(large_, std::min(std::abs(y), std::abs(last_)));
  const double least = program_rounding * large_;
  const double first = count_ > 1 ? std::abs(y - last_) : 0;
  const double second = count_ > 2 ? std::abs((y - last_) - (last_ - before_)) : 0;
  for (const double digit : {first, second})
    if (digit > least && (digit < step_ || step_ <= least)) step_ = digit;
  before_ = std::exchange(last_, y);
  near_.push(t, y);
  samples_.push_back({t, y});
  judge();
  return judged_;
}

std::span<const Sample> Outliers::finish() {
  judged_.clear();
  near_.finish();
  judge();
  scatter_.finish();
  judge();
  return judged_;
}

double Outliers::least_scatter() const { return std::max(step_ / 3, program_rounding * large_); }

/// Whether one outlier is in so many windows that these do not tell the scatter of the others.
bool Outliers::few() const { return scatter_.size() < 3 * nearby; }

std::deque<Sample>::const_iterator Outliers::at(std::size_t i) const {
  return samples_.begin() + static_cast<std::ptrdiff_t>(i - first_);
}

/// Whether sample i is on the motion of its neighbours, whose readings have this noise.
bool Outliers::belongs(std::size_t i, double noise) const {
  const Sample& s = *at(i);
  const bool inside = i >= nearby / 2 && i + nearby / 2 < count_;
  const std::size_t size = inside ? nearby : near_end;
  const std::size_t before = i - std::min(i, nearby / 2);
  const std::size_t last = count_ - std::min(count_, size);
  const std::size_t begin = std::max(first_, std::min(before, last));
  const std::size_t end = std::min(std::max(i + nearby / 2 + 1, begin + size), count_);
  const Neighbours others(at(begin), at(end), s, &s);
  if (others.size < 4) return true;
  noise = (few() ? least_scatter() : noise) / others.unit;
  Polynomial<3> motion = others.parabola();
  if (others.scatter(motion) > scatters * noise) {
    motion = others.best_parabola();
    const double own = others.scatter(motion) / of_best(others.size);
    if (few()) noise = std::max(noise, 1.5 * own);
    else if (own > 4.5 * noise) noise = own;
    motion = others.parabola(motion, 4 * noise);
  }
  const auto [value, error] = motion.derivative(0, 0);
  return std::abs(value) <= threshold_ * noise * std::sqrt(1 + error * error);
}

void Outliers::judge() {
  while (near_.next()) {
    const Sample& s = *at(near_.at());
    const Neighbours all(at(near_.begin()), at(near_.end()), s, nullptr);
    scatter_.push(s.t, std::sqrt(all.parabola().rss()) * all.unit);
  }
  while (scatter_.next()) {
    const SortedWindow& sorted = sorted_.of(scatter_);
    const std::size_t i = scatter_.at();
    const double noise =
        std::max(sorted[sorted.size() / 4] / std::sqrt(static_cast<double>(nearby - 3)) / quartile,
                 least_scatter());
    // No reading is further from the motion than the root of the RSS, in standard errors.
    const bool near_all = !few() && scatter_.sample(i).y <= threshold_ * noise;
    const auto [t, y] = *at(i);
    judged_.push_back({t, near_all || belongs(i, noise) ? y : NAN});
    for (; i > first_ + near_end; ++first_) samples_.pop_front();
  }
}

}  // namespace rolling
