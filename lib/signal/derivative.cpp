// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/derivative.h"

#include <algorithm>

#include "base/error.h"
#include "signal/savitzky_golay.h"
#include "signal/smoothing_spline.h"

namespace rolling {

// Newton's form of the parabola through three samples: slopes s1, s2 over steps h1, h2, and the
// divided difference c = (s2 - s1) / (h1 + h2). The derivatives are s1 - c h1 at the first sample,
// s1 + c h1 = s2 - c h2 at the middle one, and s2 + c h2 at the last.
double CentralDerivative::value(const Windows& window) {
  if (window.size() == 1) fail("a run of one row has no derivative");
  const std::size_t first = window.begin(), i = window.at() - first;
  const auto rise = [&](std::size_t k) {
    const Sample &a = window.sample(first + k), &b = window.sample(first + k + 1);
    return Sample{b.t - a.t, b.y - a.y};
  };
  const Sample one = rise(0);
  const double s1 = one.y / one.t;
  if (window.size() == 2) return s1;
  const Sample two = rise(1);
  const double s2 = two.y / two.t, c = (s2 - s1) / (one.t + two.t);
  return i == 0 ? s1 - c * one.t : i == 1 ? s1 + c * one.t : s2 + c * two.t;
}

// The order of operations is that of Vernier's programs, so that the results agree to the last bit:
// the weight multiplies the rise before the division.
double VernierDerivative::value(const Windows& window) {
  if (window.size() == 1) fail("a run of one row has no derivative");
  const std::size_t i = window.at(), last = window.end() - 1;
  const auto slope = [&](std::size_t k, double weight) {
    const Sample &a = window.sample(std::max(i, window.begin() + k) - k),
                 &b = window.sample(std::min(i + k, last));
    return weight * (b.y - a.y) / (b.t - a.t);
  };
  return (slope(1, 3) + slope(2, 2) + slope(3, 1)) / 6;
}

double PascoDerivative::value(const Windows& window) {
  if (window.size() == 1) fail("a run of one row has no derivative");
  const std::size_t i = window.at(), before = i - window.begin(), after = window.end() - 1 - i;
  const auto rise = [&](const Sample& a, const Sample& b) { return Sample{b.t - a.t, b.y - a.y}; };
  if (before > 0 && after > 0) {
    const Sample one = rise(window.sample(i - 1), window.sample(i + 1));
    if (before == 1 || after == 1) return one.y / one.t;
    const Sample two = rise(window.sample(i - 2), window.sample(i + 2));
    return (one.y + two.y) / (one.t + two.t);
  }
  const auto inwards = [&](std::size_t k) -> const Sample& {
    return window.sample(before == 0 ? i + k : i - k);
  };
  const Sample one = rise(inwards(0), inwards(1));
  if (window.size() == 2) return one.y / one.t;
  const Sample two = rise(inwards(1), inwards(2));
  return one.y / one.t - (two.y / two.t - one.y / one.t) / (one.t + two.t) * one.t;
}

namespace {

template <typename Derivative>
std::unique_ptr<Signal> make(const SignalOptions&) {
  return std::make_unique<Derivative>();
}

std::unique_ptr<Signal> make_savgol(const SignalOptions& options) {
  return std::make_unique<SavitzkyGolay>(options.width, options.order, SavitzkyGolay::What::slope);
}

// The spline is not linear, because its parameter depends on the readings.
constexpr SignalMethod methods[] = {
    // name, reach, linear, shift-invariant, has an order, make
    {"central", 1, true, false, false, make<CentralDerivative>},
    {"savgol", half_width, true, false, true, make_savgol},
    {"spline", whole_run, false, false, false, make<SplineDerivative>},
    {"vernier", 3, true, false, false, make<VernierDerivative>},
    {"pasco", 2, true, false, false, make<PascoDerivative>},
};

}  // namespace

const std::span<const SignalMethod> derivative_methods = methods;

}  // namespace rolling
