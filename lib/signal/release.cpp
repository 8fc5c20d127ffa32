#include "signal/release.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/dot.h"

namespace rolling {
namespace {

using Vector = std::vector<double>;

/// The residual of a vector after regression on a constant and, for positions, on a straight line
/// in time.
class Remainder {
 public:
  Remainder(std::span<const Sample> samples, bool positions) : line_(samples.size(), 0.0) {
    if (!positions) return;
    for (std::size_t i = 0; i < line_.size(); ++i) line_[i] = samples[i].t - samples[0].t;
    centre(line_);
    const double length = std::sqrt(dot(line_, line_));
    for (double& e : line_) e /= length;
  }
  void of(Vector& u) const {
    centre(u);
    const double along = dot(u, line_);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] -= along * line_[i];
  }

 private:
  static void centre(Vector& u) {
    const double mean = std::accumulate(u.begin(), u.end(), 0.0) / static_cast<double>(u.size());
    for (double& e : u) e -= mean;
  }
  Vector line_;
};

/// The residual sum of squares as a function of the sample at which the body is released.
class Residuals {
 public:
  Residuals(std::span<const Sample> samples, bool positions, double falling)
      : samples_(samples), positions_(positions), remainder_(samples, positions),
        bend_(samples.size()) {
    for (const Sample& s : samples) y_.push_back(falling * (s.y - samples[0].y));
    remainder_.of(y_);
    whole_ = dot(y_, y_);
  }
  double at(std::size_t released) {
    for (std::size_t i = 0; i < bend_.size(); ++i) {
      const double since = std::max(0.0, samples_[i].t - samples_[released].t);
      bend_[i] = -(positions_ ? since * since / 2 : since);
    }
    remainder_.of(bend_);
    const double along = std::max(0.0, dot(bend_, y_));  // a released body does not accelerate
    return whole_ - along * along / dot(bend_, bend_);
  }
  /// The variance of the noise, from the least sum of squares. Two coefficients (three for
  /// positions) and the time of release were fitted. A sum below 1e-12 of the total is a rounding
  /// error.
  double variance(double least) const {
    return std::max(least, 1e-12 * whole_) /
           static_cast<double>(bend_.size() - (positions_ ? 4 : 3));
  }

 private:
  std::span<const Sample> samples_;
  bool positions_;
  Remainder remainder_;
  Vector y_, bend_;
  double whole_;
};

}  // namespace

Release release_of(std::span<const Sample> samples, bool positions, double falling) {
  constexpr std::size_t trials = 50;
  const std::size_t latest = samples.size() - 5;  // 5 samples determine the slope after the release
  Residuals residuals(samples, positions, falling);
  const double held_never = residuals.at(0);
  double least = held_never;
  std::size_t from = 0, to = latest;
  for (std::size_t step = latest + 1, finer; (finer = (to - from) / trials + 1) < step;) {
    step = finer;
    Vector sums;
    for (std::size_t i = from; i <= to; i += step) {
      sums.push_back(residuals.at(i));
      least = std::min(least, sums.back());
    }
    const double most = least + 2.5 * 2.5 * residuals.variance(least);
    const auto within = [&](double sum) { return sum <= most; };
    const auto first = std::find_if(sums.begin(), sums.end(), within);
    if (first == sums.end()) break;  // without noise, the finer grid may miss the least sum
    const auto last = std::find_if(sums.rbegin(), sums.rend(), within);
    const auto at = [&](std::ptrdiff_t i) { return from + static_cast<std::size_t>(i) * step; };
    const std::size_t begin = at(first - sums.begin()), end = at(sums.rend() - last - 1);
    from = begin - std::min(step - 1, begin);
    to = std::min(end + step - 1, latest);
  }
  return {from, to, std::sqrt((held_never - least) / residuals.variance(least))};
}

}  // namespace rolling
