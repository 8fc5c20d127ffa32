// SPDX-License-Identifier: GPL-3.0-or-later
// A band matrix with its zeros, row by row.
#pragma once

#include "noise/filter_matrix.h"

namespace rolling {

inline std::vector<double> dense(const FilterMatrix& M, std::size_t columns) {
  std::vector<double> all(M.rows() * columns, 0);
  FilterMatrix::Row row;
  for (std::size_t i = 0; i < M.rows(); ++i) {
    M.row(i, row);
    for (std::size_t j = 0; j < row.values.size(); ++j)
      all[i * columns + row.first + j] = row.values[j];
  }
  return all;
}

}  // namespace rolling
