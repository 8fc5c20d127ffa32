// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/derivative.h"

#include <algorithm>

namespace rolling {
namespace {

// Newton's form of the parabola through three samples: slopes s1, s2 over steps h1, h2, and the
// divided difference c = (s2 - s1) / (h1 + h2). The derivatives are s1 - c h1 at the first sample,
// s1 + c h1 = s2 - c h2 at the middle one, and s2 + c h2 at the last.
double central_slope(const Windows& window) {
  require_slope(window.size());
  const Sample& first = window.sample(window.begin());
  const Sample& middle = window.sample(window.begin() + 1);
  const Sample& last = window.sample(window.end() - 1);
  const double h1 = middle.t - first.t;
  const double s1 = (middle.y - first.y) / h1;
  if (window.size() == 2) return s1;
  const double h2 = last.t - middle.t;
  const double s2 = (last.y - middle.y) / h2;
  const double c = (s2 - s1) / (h1 + h2);
  if (window.at() == window.begin()) return s1 - c * h1;
  return window.at() + 1 == window.end() ? s2 + c * h2 : s1 + c * h1;
}

// The order of operations is that of Vernier's programs, so that the results agree to the last bit:
// the weight multiplies the rise before the division.
double vernier_slope(const Windows& window) {
  require_slope(window.size());
  const std::size_t i = window.at();
  const std::size_t last = window.end() - 1;
  const auto slope = [&](std::size_t k, double weight) {
    const Sample& a = window.sample(std::max(i, window.begin() + k) - k);
    const Sample& b = window.sample(std::min(i + k, last));
    return weight * (b.y - a.y) / (b.t - a.t);
  };
  return (slope(1, 3) + slope(2, 2) + slope(3, 1)) / 6;
}

double pasco_slope(const Windows& window) {
  const std::size_t i = window.at();
  const std::size_t before = i - window.begin();
  const std::size_t after = window.end() - 1 - i;
  if (before == 0 || after == 0) return central_slope(window);
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

}  // namespace

std::unique_ptr<Signal> central_derivative() {
  return windowed({3, 0}, Windows::Ends::stay, [](const Windows& w) { return central_slope(w); });
}
std::unique_ptr<Signal> vernier_derivative() {
  return windowed({7, 0}, Windows::Ends::cut, [](const Windows& w) { return vernier_slope(w); });
}
std::unique_ptr<Signal> pasco_derivative() {
  return windowed({5, 0}, Windows::Ends::cut, [](const Windows& w) { return pasco_slope(w); });
}

}  // namespace rolling
