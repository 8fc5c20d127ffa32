// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/savitzky_golay.h"

#include <algorithm>
#include <utility>

#include "base/error.h"

namespace rolling {

LocalPolynomial::Point LocalPolynomial::operator()(std::span<const Sample> samples,
                                                   const Sample& here, std::size_t order) {
  const std::size_t n = samples.size();
  const double reach = std::max(here.t - samples.front().t, samples.back().t - here.t);
  const double scale = reach > 0 ? reach : 1;
  u_.resize(n);
  rest_.resize(n);
  p_.assign(n, 1);
  before_.assign(n, 0);
  for (std::size_t j = 0; j < n; ++j) {
    u_[j] = (samples[j].t - here.t) / scale;
    rest_[j] = samples[j].y - here.y;
  }
  // The three-term recurrence p(k+1) = (u - alpha) p(k) - beta p(k-1), at the samples, and at u = 0
  // for value and slope.
  Point result{here.y, 0};
  double at = 1;
  double slope = 0;
  double at_before = 0;
  double slope_before = 0;
  double norm_before = 1;
  for (std::size_t k = 0; k <= std::min(order, n - 1); ++k) {
    double norm = 0;
    double moment = 0;
    double c = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const double square = p_[j] * p_[j];
      norm += square;
      moment += u_[j] * square;
      c += rest_[j] * p_[j];
    }
    c /= norm;
    result.value += c * at;
    result.slope += c * slope / scale;
    const double alpha = moment / norm;
    const double beta = k > 0 ? norm / norm_before : 0;
    for (std::size_t j = 0; j < n; ++j) {
      rest_[j] -= c * p_[j];
      before_[j] = (u_[j] - alpha) * p_[j] - beta * before_[j];
    }
    std::swap(p_, before_);
    slope_before = std::exchange(slope, at - alpha * slope - beta * slope_before);
    at_before = std::exchange(at, -alpha * at - beta * at_before);
    norm_before = norm;
  }
  return result;
}

SavitzkyGolay::SavitzkyGolay(Width width, std::size_t order, What what)
    : WindowedSignal(width, Windows::Ends::stay), order_(order), what_(what) {
  if (order > most_order) fail("a polynomial of order {}: at most {}", order, most_order);
  if (width.seconds == 0 && order >= width.samples)
    fail("a polynomial of order {} needs a window of more than {} samples", order, width.samples);
}

double SavitzkyGolay::value(const Windows& window) {
  if (what_ == What::slope) require_slope(window.size());
  samples_.clear();
  for (std::size_t i = window.begin(); i < window.end(); ++i) samples_.push_back(window.sample(i));
  const auto [value, slope] = polynomial_(samples_, window.sample(window.at()), order_);
  return what_ == What::value ? value : slope;
}

}  // namespace rolling
