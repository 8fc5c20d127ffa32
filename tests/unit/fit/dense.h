// A band matrix with its zeros, row by row.
#pragma once

#include "fit/band_matrix.h"

namespace rolling {

inline std::vector<double> dense(const BandMatrix& M, std::size_t columns) {
  std::vector<double> all(M.rows() * columns, 0);
  for (std::size_t i = 0; i < M.rows(); ++i)
    for (std::size_t j = 0; j < M.row(i).size(); ++j)
      all[i * columns + M.first(i) + j] = M.row(i)[j];
  return all;
}

}  // namespace rolling
