// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/road.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"

namespace rolling {

Road::Road(std::vector<double> x, std::vector<double> h)
    : x_(std::move(x)), h_(std::move(h)), bend_(x_.size()) {
  const std::size_t n = x_.size();
  if (n < 2) fail("a table of heights needs two rows at least");
  for (std::size_t i = 0; i < n; ++i)
    if (!std::isfinite(x_[i]) || !std::isfinite(h_[i]) || (i > 0 && !(x_[i] > x_[i - 1])))
      fail("the table of heights is not increasing: x = {} follows x = {}", x_[i],
           i > 0 ? x_[i - 1] : x_[i]);
  // Tridiagonal equations for the second derivatives, by elimination.
  std::vector<double> above(n);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = x_[i] - x_[i - 1];
    const double after = x_[i + 1] - x_[i];
    const double rise = 6 * ((h_[i + 1] - h_[i]) / after - (h_[i] - h_[i - 1]) / before);
    double middle = 2 * (before + after);
    if (i == 1) middle += before;
    else middle -= before * above[i - 1];
    if (i + 2 == n) middle += after;
    above[i] = after / middle;
    bend_[i] = (rise - (i > 1 ? before * bend_[i - 1] : 0)) / middle;
  }
  for (std::size_t i = n - 2; i > 1; --i) bend_[i - 1] -= above[i - 1] * bend_[i];
  if (n > 2) {
    bend_[0] = bend_[1];
    bend_[n - 1] = bend_[n - 2];
  }
  for (const double place : x_)
    if (!(std::abs(at(place).h1) < 1))
      fail("the table of heights is too steep at x = {}: it rises by {:.4g} m a metre of the way",
           place, at(place).h1);
}

Road::Place Road::at(double x) const {
  const auto next = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
  const auto i = static_cast<std::size_t>(next - x_.begin()) - 1;
  const double width = x_[i + 1] - x_[i];
  const double third = (bend_[i + 1] - bend_[i]) / width;
  const double s = x - x_[i];
  const double first = (h_[i + 1] - h_[i]) / width - width * (2 * bend_[i] + bend_[i + 1]) / 6;
  return {h_[i] + s * (first + s * (bend_[i] / 2 + s * third / 6)),
          first + s * (bend_[i] + s * third / 2), bend_[i] + s * third, third};
}

void Road::check(double x) const {
  if (x >= x_.front() && x <= x_.back()) return;
  const auto [least, most] = std::minmax({way_ * x_.front(), way_ * x_.back()});
  fail("x = {:.6g} m is outside of the table of heights, {} to {}", way_ * x, least, most);
}

const Road* Road::mirrored() const {
  if (mirrored_) return mirrored_.get();
  std::vector<double> x(x_.rbegin(), x_.rend());
  for (double& place : x) place = -place;
  const std::vector<double> h(h_.rbegin(), h_.rend());
  auto road = std::make_unique<Road>(std::move(x), h);
  road->way_ = -way_;
  mirrored_ = std::move(road);
  return mirrored_.get();
}

}  // namespace rolling
