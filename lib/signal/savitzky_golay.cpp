// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/savitzky_golay.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/error.h"

namespace rolling {
namespace {

/// The value and the slope, at one time, of the least-squares polynomial through samples.
/// Orthogonal polynomials (Forsythe 1957, J. SIAM 5, 74) in the time relative to that one keep the
/// problem well conditioned.
class LocalPolynomial {
 public:
  /// Of the samples of a window, at its own sample, whose reading is subtracted first. The order is
  /// reduced to the number of samples (at least one) minus one where necessary.
  std::array<double, 2> operator()(const Windows& window, std::size_t order) {
    const std::size_t n = window.size();
    const Sample& here = window.sample(window.at());
    const double reach = std::max(here.t - window.sample(window.begin()).t,
                                  window.sample(window.end() - 1).t - here.t);
    const double scale = reach > 0 ? reach : 1;
    u_.resize(n);
    rest_.resize(n);
    p_.assign(n, 1);
    before_.assign(n, 0);
    for (std::size_t j = 0; j < n; ++j) {
      const Sample& sample = window.sample(window.begin() + j);
      u_[j] = (sample.t - here.t) / scale;
      rest_[j] = sample.y - here.y;
    }
    // The three-term recurrence p(k+1) = (u - alpha) p(k) - beta p(k-1), at the samples, and at u =
    // 0 for value and slope.
    std::array<double, 2> sum{here.y, 0};
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
      sum[0] += c * at;
      sum[1] += c * slope / scale;
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
    return sum;
  }

 private:
  std::vector<double> u_, rest_, p_, before_;
};

}  // namespace

std::unique_ptr<Signal> savitzky_golay(Width width, std::size_t order, std::size_t derivative) {
  const auto value = [=, polynomial = LocalPolynomial()](const Windows& window) mutable {
    if (derivative == 1) require_slope(window.size());
    return polynomial(window, order)[derivative];
  };
  auto filter = windowed(width, Windows::Ends::stay, value);
  if (order > most_order) fail("a polynomial of order {}: at most {}", order, most_order);
  if (width.seconds == 0 && order >= width.samples)
    fail("a polynomial of order {} needs a window of more than {} samples", order, width.samples);
  return filter;
}

}  // namespace rolling
