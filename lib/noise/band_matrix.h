// SPDX-License-Identifier: GPL-3.0-or-later
// The matrix of a chain of filters, which maps the raw column to a filtered one.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace rolling {

/// A band matrix: its rows are zero outside a short range of columns.
class BandMatrix {
 public:
  explicit BandMatrix(std::size_t columns) : columns_(columns) {}
  static BandMatrix identity(std::size_t n);
  /// Appends a row whose first element is in column `first`. Zeros at either end of the row are not
  /// stored, and consecutive equal rows share their elements.
  void append(std::size_t first, std::span<const double> values);
  std::size_t rows() const { return rows_.size(); }
  std::size_t columns() const { return columns_; }
  std::size_t first(std::size_t i) const { return rows_[i].first; }
  std::size_t end(std::size_t i) const { return rows_[i].first + rows_[i].size; }
  std::span<const double> row(std::size_t i) const {
    return {values_.data() + rows_[i].start, rows_[i].size};
  }
  /// True if row i has the elements of row i - 1, one column further on.
  bool repeats(std::size_t i) const {
    return i > 0 && rows_[i].start == rows_[i - 1].start && first(i) == first(i - 1) + 1;
  }
  /// The matrix of these rows alone.
  BandMatrix of_rows(std::span<const std::size_t> rows) const;
  /// The product with a matrix X that holds its columns one after another, as the product does.
  std::vector<double> times(std::span<const double> X) const;
  /// The product of the transposed matrix with a vector.
  std::vector<double> transposed_times(std::span<const double> x) const;

 private:
  struct Row {
    std::size_t first, start, size;  // start: index into values_
  };
  std::size_t columns_;
  std::vector<Row> rows_;
  std::vector<double> values_;
};

/// The product: M filters first. It has no more elements than the two together.
BandMatrix operator*(const BandMatrix& L, const BandMatrix& M);

/// The inner product of row i of L and row j of M.
double dot(const BandMatrix& L, std::size_t i, const BandMatrix& M, std::size_t j);

/// The filters of a column. They are large, and those who read them share them.
using Filters = std::shared_ptr<const BandMatrix>;

}  // namespace rolling
