// SPDX-License-Identifier: GPL-3.0-or-later
// Small least-squares problems for the tests.
#pragma once

#include "least_squares/minimise.h"

#include <functional>
#include <vector>

namespace systems {

/// One run of n residuals of p parameters; J is filled column by column.
inline rolling::System one_run(
    std::size_t n, std::size_t p,
    std::function<void(const std::vector<double>&, std::vector<double>&, std::vector<double>&)>
        fill) {
  return {{n}, 0, p, [=](const std::vector<double>& x, const rolling::TakeRows& take) {
            std::vector<double> f(n), J(n * p);
            fill(x, f, J);
            take(0, f, J);
          }};
}

/// A straight line through the points (t, y).
inline rolling::System line_through(const std::vector<double>& t, const std::vector<double>& y) {
  const std::size_t n = t.size();
  return one_run(n, 2,
                 [=](const std::vector<double>& x, std::vector<double>& f, std::vector<double>& J) {
    for (std::size_t i = 0; i < n; ++i) f[i] = x[0] + x[1] * t[i] - y[i], J[i] = 1, J[n + i] = t[i];
  });
}

}  // namespace systems
