// SPDX-License-Identifier: GPL-3.0-or-later
// A band matrix with its zeros, row by row.
#pragma once

#include "noise/band_matrix.h"

#include <algorithm>

namespace rolling {

inline std::vector<double> dense(const BandMatrix& M) {
  std::vector<double> all(M.rows() * M.columns());
  for (std::size_t i = 0; i < M.rows(); ++i)
    std::ranges::copy(M.row(i), &all[i * M.columns() + M.first(i)]);
  return all;
}

}  // namespace rolling
