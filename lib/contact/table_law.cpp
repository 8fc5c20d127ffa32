// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/table_law.h"

#include <gsl/gsl_interp.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/gsl.h"

namespace rolling {

TableLaw::TableLaw(std::vector<double> v, std::vector<double> D) {
  if (v.empty() || v.size() != D.size())
    fail("a table of a law needs a point at least, and a D to each v");
  std::vector<std::size_t> order(v.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return v[i] < v[j]; });
  for (const std::size_t i : order) {
    if (!(v[i] >= 0 && std::isfinite(v[i])))
      fail("v = {} in the table of a law must be a number that is not negative", v[i]);
    if (!(D[i] > 0 && std::isfinite(D[i])))
      fail("D = {} at v = {} in the table of a law must be a positive number", D[i], v[i]);
    if (!v_.empty() && v[i] == v_.back()) fail("v = {} stands twice in the table of a law", v[i]);
    v_.push_back(v[i]);
    D_.push_back(D[i]);
  }
  const std::size_t n = v_.size();
  if (n == 1) return;
  silence_gsl();
  const auto gsl =
      own(gsl_interp_alloc(n > 2 ? gsl_interp_steffen : gsl_interp_linear, n), gsl_interp_free);
  gsl_interp_init(gsl.get(), v_.data(), D_.data(), n);
  const auto slope_at = [&](std::size_t i) {
    return gsl_interp_eval_deriv(gsl.get(), v_.data(), D_.data(), v_[i], nullptr);
  };
  // The coefficients are kept here: gsl_interp_eval in their place made rolls measurably slower.
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double h = v_[i + 1] - v_[i], s = (D_[i + 1] - D_[i]) / h, begin = slope_at(i),
                 end = slope_at(i + 1);
    c1_.push_back(begin);
    c2_.push_back((3 * s - 2 * begin - end) / h);
    c3_.push_back((begin + end - 2 * s) / (h * h));
  }
}

Shift TableLaw::at(double v) const {
  if (v < v_.front() || v_.size() == 1) return {D_.front(), 0};
  if (v > v_.back()) return {D_.back() + c1_.back() * (v - v_.back()), v * c1_.back()};
  const auto above = std::upper_bound(v_.begin() + 1, v_.end() - 1, v);
  const auto i = static_cast<std::size_t>(above - v_.begin()) - 1;
  const double s = v - v_[i], c1 = c1_[i], c2 = c2_[i], c3 = c3_[i];
  const auto [least, most] = std::minmax(D_[i], D_[i + 1]);  // rounding may lead beyond them
  return {std::clamp(D_[i] + s * (c1 + s * (c2 + s * c3)), least, most),
          v * (c1 + s * (2 * c2 + 3 * s * c3))};
}

}  // namespace rolling
