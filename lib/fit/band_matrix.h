// A band matrix: its rows are zero outside a short range of columns. It represents a linear filter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rolling {

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
  std::size_t first(std::size_t i) const { return rows_[i].first; }
  std::size_t end(std::size_t i) const { return rows_[i].first + rows_[i].size; }
  std::span<const double> row(std::size_t i) const {
    return {values_.data() + rows_[i].start, rows_[i].size};
  }
  /// The largest distance, over the rows, from the first column of a row to the end of the columns
  /// that this row or an earlier one reaches: the number of input samples that must be kept when
  /// rows are computed in order.
  std::size_t window() const { return window_; }
  /// The matrix of these rows alone.
  BandMatrix of_rows(std::span<const std::size_t> rows) const;

 private:
  struct Row {
    std::uint32_t start, first, size;  // start: index into values_
  };
  std::vector<Row> rows_;
  std::vector<double> values_;
  std::size_t columns_ = 0, window_ = 0;
};

}  // namespace rolling
