// SPDX-License-Identifier: GPL-3.0-or-later
// A matrix with many rows and few columns, such as J; the parts of its columns that belong to each
// run; inner products.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rolling {

/// The columns of a matrix, each in memory of its own.
using Matrix = std::vector<std::vector<double>>;

/// Views of consecutive parts of `all`, one for each run: of sizes[r] numbers.
auto by_run(auto& all, const auto& sizes) {
  std::span rest(all);
  std::vector<decltype(rest)> parts;
  for (const std::size_t rows : sizes) {
    parts.push_back(rest.first(rows));
    rest = rest.subspan(rows);
  }
  return parts;
}

/// The same for the rows of a matrix: for each run, a view of each column.
auto rows_by_run(auto& matrix, const auto& sizes) {
  std::vector<std::vector<decltype(std::span(matrix[0]))>> parts(std::size(sizes));
  for (auto& column : matrix) {
    auto run = parts.begin();
    for (const auto part : by_run(column, sizes)) (run++)->push_back(part);
  }
  return parts;
}

/// The inner product in four independent partial sums: in a single sum each addition would wait for
/// the one before it.
inline double dot(const double* x, const double* y, std::size_t n) {
  double a = 0;
  double b = 0;
  double c = 0;
  double d = 0;
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
