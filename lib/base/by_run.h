// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of a column, or of a matrix, of all runs that belong to each run.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rolling {

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

}  // namespace rolling
