// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/band_matrix.h"

#include <algorithm>

#include "base/matrix.h"

namespace rolling {

BandMatrix BandMatrix::identity(std::size_t n) {
  BandMatrix I(n);
  constexpr double one = 1;
  for (std::size_t i = 0; i < n; ++i) I.append(i, {&one, 1});
  return I;
}

void BandMatrix::append(std::size_t first, std::span<const double> values) {
  while (!values.empty() && values.back() == 0) values = values.first(values.size() - 1);
  while (!values.empty() && values.front() == 0) {
    values = values.subspan(1);
    ++first;
  }
  const bool same = rows() > 0 && std::ranges::equal(row(rows() - 1), values);
  rows_.push_back({first, same ? rows_.back().start : values_.size(), values.size()});
  if (!same) values_.insert(values_.end(), values.begin(), values.end());
}

BandMatrix BandMatrix::of_rows(std::span<const std::size_t> rows) const {
  BandMatrix few(columns_);
  for (std::size_t i : rows) few.append(first(i), row(i));
  return few;
}

std::vector<double> BandMatrix::times(std::span<const double> X) const {
  std::vector<double> product(X.size() / columns_ * rows());
  for (std::size_t i = 0; i < rows(); ++i) {
    const double* x = X.data() + first(i);
    for (std::size_t at = i; at < product.size(); at += rows(), x += columns_)
      product[at] = dot(row(i).data(), x, row(i).size());
  }
  return product;
}

std::vector<double> BandMatrix::transposed_times(std::span<const double> x) const {
  std::vector<double> product(columns_);
  for (std::size_t i = 0; i < rows(); ++i)
    for (std::size_t k = 0; k < row(i).size(); ++k) product[first(i) + k] += row(i)[k] * x[i];
  return product;
}

BandMatrix operator*(const BandMatrix& L, const BandMatrix& M) {
  BandMatrix product(M.columns());
  std::vector<double> sum(M.columns());
  for (std::size_t i = 0; i < L.rows(); ++i) {
    bool repeats = L.repeats(i);
    std::size_t first = M.columns();
    std::size_t end = 0;
    for (std::size_t k = L.first(i); k < L.end(i); ++k) {
      repeats &= M.repeats(k);
      first = std::min(first, M.first(k));
      end = std::max(end, M.end(k));
    }
    if (repeats) {
      product.append(product.first(i - 1) + 1, product.row(i - 1));
      continue;
    }
    for (std::size_t k = L.first(i); k < L.end(i); ++k)
      for (std::size_t j = 0; j < M.row(k).size(); ++j)
        sum[M.first(k) + j] += L.row(i)[k - L.first(i)] * M.row(k)[j];
    if (first > end) first = end;
    product.append(first, std::span(sum).subspan(first, end - first));
    std::fill_n(&sum[first], end - first, 0.0);
  }
  return product;
}

double dot(const BandMatrix& L, std::size_t i, const BandMatrix& M, std::size_t j) {
  const std::size_t from = std::max(L.first(i), M.first(j));
  const std::size_t to = std::min(L.end(i), M.end(j));
  return from < to ? dot(&L.row(i)[from - L.first(i)], &M.row(j)[from - M.first(j)], to - from) : 0;
}

}  // namespace rolling
