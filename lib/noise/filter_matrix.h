// SPDX-License-Identifier: GPL-3.0-or-later
// The matrix of a chain of filters, which maps the raw column to a filtered one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace rolling {

/// A band matrix: its rows are zero outside a short range of columns. It represents a linear
/// filter.
class BandMatrix {
 public:
  BandMatrix() = default;
  static BandMatrix identity(std::size_t n);
  bool is_identity() const;
  /// Reserves memory for this number of rows and of stored elements.
  void reserve(std::size_t rows, std::size_t numbers);
  /// Appends a row whose first element is in column `first`. Zeros at either end of the row are not
  /// stored, and consecutive equal rows share their elements. Throws Error beyond 2^32 - 1
  /// elements.
  void append(std::size_t first, std::span<const double> values);
  std::size_t rows() const { return rows_.size(); }
  /// One more than the last column with an element.
  std::size_t columns() const { return columns_; }
  std::size_t first(std::size_t i) const {
    return static_cast<std::uint32_t>(i) - shapes_[rows_[i]].before;
  }
  std::size_t end(std::size_t i) const { return first(i) + shapes_[rows_[i]].size; }
  std::span<const double> row(std::size_t i) const {
    const Shape& shape = shapes_[rows_[i]];
    return {values_.data() + shape.start, shape.size};
  }
  /// True if row i has the elements of row i - 1, one column further on.
  bool repeats(std::size_t i) const { return i > 0 && rows_[i] == rows_[i - 1]; }
  /// The largest distance, over the rows, from the first column of a row to the end of the columns
  /// that this row or an earlier one reaches: the number of input samples that must be kept when
  /// rows are computed in order.
  std::size_t window() const { return window_; }
  /// The matrix of these rows alone.
  BandMatrix of_rows(std::span<const std::size_t> rows) const;
  bool operator==(const BandMatrix&) const = default;

 private:
  /// What the rows of a stretch have in common.
  struct Shape {
    std::uint32_t before, start, size;  // before: row number minus first column, modulo 2^32;
                                        // start: index into values_
    bool operator==(const Shape&) const = default;
  };
  std::vector<Shape> shapes_;
  std::vector<std::uint32_t> rows_;  // indices into shapes_
  std::vector<double> values_;
  std::size_t columns_ = 0, window_ = 0;
};

/// A product of band matrices, the first filter rightmost. The product is not multiplied out,
/// because each factor is narrower than the product.
class FilterMatrix {
 public:
  FilterMatrix(BandMatrix);
  /// The product of L and this matrix. If L is equal to one of its factors, it is stored once.
  FilterMatrix then(BandMatrix L) const;
  /// The matrix of these rows alone.
  FilterMatrix of_rows(std::span<const std::size_t> rows) const;

  std::size_t rows() const { return factors_.back()->rows(); }
  std::size_t columns() const { return columns_; }

  /// A range of columns, or of rows.
  struct Range {
    std::size_t first, end;
  };
  /// The columns in which row i of the product may have an element; cheaper than the row.
  Range columns_of(std::size_t i) const;
  /// One row of the product, from its first nonzero column.
  struct Row {
    std::size_t first = 0;
    std::vector<double> values, spare;

    std::size_t end() const { return first + values.size(); }
  };
  /// Writes row i. A caller that reads row after row passes the same Row again, so that its memory
  /// is reused.
  void row(std::size_t i, Row& to) const;
  /// True if row i is known to have the elements of row i - 1, one column further on.
  bool repeats(std::size_t i) const;
  /// The product with a vector of columns() elements.
  std::vector<double> times(std::span<const double> x) const;
  /// The product of the transposed matrix with a vector of rows() elements.
  std::vector<double> transposed_times(std::vector<double> x) const;

 private:
  friend class FilterPass;
  std::size_t columns_;
  std::vector<std::shared_ptr<const BandMatrix>> factors_;  // in the order of application
};

/// The inner product of two rows.
double dot(const FilterMatrix::Row&, const FilterMatrix::Row&);

/// Multiplies a filter matrix by a matrix of `columns` columns, row by row: neither the factors are
/// multiplied out nor is the product stored.
class FilterPass {
 public:
  /// The callback receives the rows of the product in order; it may overwrite them.
  FilterPass(const FilterMatrix&, std::size_t columns, std::function<void(double* row)> take);
  /// The memory for the next row of the input; push() reads the row from there.
  double* place() { return place(0); }
  /// Passes the rows of the product that need no further input to the callback.
  void push() { push(0); }
  /// The number of elements that a row needs: `columns`, rounded up to an even number.
  static std::size_t stride(std::size_t columns) { return (columns + 1) / 2 * 2; }

 private:
  struct Stage {
    const BandMatrix* L;
    std::vector<double> in;  // the input rows base .. count - 1
    std::size_t base = 0, count = 0, row = 0;
  };
  double* place(std::size_t stage);
  void push(std::size_t stage);
  void multiply(const Stage&, double* out) const;

  std::size_t stride_;
  std::vector<Stage> stages_;
  std::vector<double> product_;  // the last row
  std::function<void(double* row)> take_;
};

}  // namespace rolling
