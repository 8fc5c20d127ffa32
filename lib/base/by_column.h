// The columns of a matrix that is stored row by row, one after another.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace rolling {

/// Replaces each of the columns of X, which is stored row by row, by function(column); all results
/// have the same length, which may differ from that of the columns. In place: beside X there is
/// memory for single columns alone.
std::vector<double> by_column(std::vector<double> X, std::size_t columns, auto&& function) {
  if (columns == 1) return function(std::move(X));
  const std::size_t rows = X.size() / columns;
  for (std::size_t c = 0; c < columns; ++c) {
    std::vector<double> column(rows);
    for (std::size_t i = 0; i < rows; ++i) column[i] = X[i * columns + c];
    column = function(std::move(column));
    X.resize(std::max(X.size(), column.size() * columns));
    for (std::size_t i = 0; i < column.size(); ++i) X[i * columns + c] = column[i];
    if (c + 1 == columns) X.resize(column.size() * columns);
  }
  return X;
}

}  // namespace rolling
