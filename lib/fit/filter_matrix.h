// The matrix of a chain of filters, which maps the raw column to a filtered one.
#pragma once

#include "fit/band_matrix.h"

#include <memory>

namespace rolling {

/// A product of band matrices, the first filter rightmost. The product is not multiplied out,
/// because each factor is narrower than the product. An additional last row (the "border") may
/// reach over the whole run; it holds the mean of a column.
class FilterMatrix {
 public:
  FilterMatrix(BandMatrix);
  static FilterMatrix identity(std::size_t n);
  /// The product of L and this matrix.
  FilterMatrix then(BandMatrix L) const;
  /// The matrix of these rows alone.
  FilterMatrix of_rows(std::span<const std::size_t> rows) const;
  /// This matrix with the border `row` (one element for each column) below it.
  FilterMatrix with_last_row(std::vector<double> row) const;

  std::size_t rows() const { return band_rows() + bordered(); }
  std::size_t columns() const { return columns_; }
  /// The number of rows without the border.
  std::size_t band_rows() const { return factors_.empty() ? columns_ : factors_.back()->rows(); }
  bool bordered() const { return border_ != nullptr; }
  std::span<const double> last_row() const { return *border_; }

  /// One row of the product without the border, from its first nonzero column.
  struct Row {
    std::size_t first = 0;
    std::vector<double> values, spare;

    std::size_t end() const { return first + values.size(); }
  };
  /// Writes row i. A caller that reads row after row passes the same Row again, so that its memory
  /// is reused.
  void row(std::size_t i, Row& to) const;
  /// The product with a vector of columns() elements.
  std::vector<double> times(std::span<const double> x) const;
  /// The product of the transposed matrix with X, which is stored row by row with `columns`
  /// elements in each of its rows() rows.
  std::vector<double> transposed_times(std::span<const double> X, std::size_t columns = 1) const;

 private:
  friend class FilterPass;
  explicit FilterMatrix(std::size_t columns) : columns_(columns) {}

  std::size_t columns_;
  std::vector<std::shared_ptr<const BandMatrix>> factors_;  // in the order of application
  std::shared_ptr<const std::vector<double>> border_;
};

/// Multiplies a filter matrix by a matrix of `columns` columns, row by row: neither the factors are
/// multiplied out nor is the product stored.
class FilterPass {
 public:
  FilterPass(const FilterMatrix&, std::size_t columns);
  /// The number of elements that a row occupies: `columns`, rounded up to an even number.
  std::size_t stride() const { return stride_; }
  /// The memory for the next row of the input; push() reads the row from there.
  double* place() { return raw_.data(); }
  void push();
  /// The next row of the product; null if it needs further input. Valid until the next call.
  double* next();

 private:
  struct Stage {
    const BandMatrix* L;
    std::vector<double> in;  // the input rows base .. count - 1
    std::size_t base, count, row;
    std::vector<double> out;
  };
  double* next_of(std::size_t stage);

  const FilterMatrix& H_;
  std::size_t stride_, pushed_ = 0;
  std::vector<double> raw_, last_;
  bool fresh_ = false, last_given_ = false;
  std::vector<Stage> stages_;
};

}  // namespace rolling
