// SPDX-License-Identifier: GPL-3.0-or-later
// Inner products.
#pragma once

#include <cstddef>
#include <span>

namespace rolling {

/// The inner product in four independent partial sums: in a single sum each addition would wait for
/// the one before it.
inline double dot(const double* x, const double* y, std::size_t n) {
  double a = 0, b = 0, c = 0, d = 0;
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    a += x[i] * y[i];
    b += x[i + 1] * y[i + 1];
    c += x[i + 2] * y[i + 2];
    d += x[i + 3] * y[i + 3];
  }
  for (; i < n; ++i) a += x[i] * y[i];
  return (a + b) + (c + d);
}
/// The inner product of two rows of the length of x.
inline double dot(std::span<const double> x, std::span<const double> y) {
  return dot(x.data(), y.data(), x.size());
}

}  // namespace rolling
