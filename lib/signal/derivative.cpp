// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/derivative.h"

#include <algorithm>

namespace rolling {

// Newton's form of the parabola through three samples: slopes s1, s2 over steps h1, h2, and the
// divided difference c = (s2 - s1) / (h1 + h2). The derivatives are s1 - c h1 at the first sample,
// s1 + c h1 = s2 - c h2 at the middle one, and s2 + c h2 at the last.
std::span<const double> CentralDerivative::push(double t, double y) {
  const double step = t - t_, slope = (y - y_) / step;
  ++count_;
  std::size_t known = 0;
  if (count_ >= 3) {
    bend_ = (slope - slope_) / (step_ + step);
    if (count_ == 3) known_[known++] = slope_ - bend_ * step_;
    known_[known++] = slope_ + bend_ * step_;
  }
  t_ = t;
  y_ = y;
  step_ = step;
  slope_ = slope;
  return {known_.data(), known};
}

std::span<const double> CentralDerivative::finish() {
  if (count_ == 0) return {};
  require_slope(count_);
  known_[0] = known_[1] = slope_ + bend_ * step_;  // bend_ is 0 in a run of two
  return {known_.data(), count_ == 2 ? std::size_t{2} : std::size_t{1}};
}

// The order of operations is that of Vernier's programs, so that the results agree to the last bit:
// the weight multiplies the rise before the division.
double VernierDerivative::value(const Windows& window) {
  require_slope(window.size());
  const std::size_t i = window.at(), last = window.end() - 1;
  const auto slope = [&](std::size_t k, double weight) {
    const Sample& a = window.sample(std::max(i, window.begin() + k) - k);
    const Sample& b = window.sample(std::min(i + k, last));
    return weight * (b.y - a.y) / (b.t - a.t);
  };
  return (slope(1, 3) + slope(2, 2) + slope(3, 1)) / 6;
}

double PascoDerivative::value(const Windows& window) {
  const std::size_t i = window.at(), before = i - window.begin(), after = window.end() - 1 - i;
  if (before == 0 || after == 0) {
    CentralDerivative parabola;
    const auto slopes = output_of(parabola, window.size(),
                                  [&](std::size_t k) { return window.sample(window.begin() + k); });
    return before == 0 ? slopes.front() : slopes.back();
  }
  const auto rise = [&](std::size_t k) {
    const Sample& a = window.sample(i - k);
    const Sample& b = window.sample(i + k);
    return Sample{b.t - a.t, b.y - a.y};
  };
  const Sample one = rise(1);
  if (before == 1 || after == 1) return one.y / one.t;
  const Sample two = rise(2);
  return (one.y + two.y) / (one.t + two.t);
}

}  // namespace rolling
