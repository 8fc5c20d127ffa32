// A matrix whose rows are zero outside a short stretch: what a filter does to a column.
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
  /// Makes room for so many rows of so many numbers in all.
  void reserve(std::size_t rows, std::size_t numbers);
  /// Appends a row; zeros at either end of it are not stored, and equal rows, one after another,
  /// share their numbers.
  void append(std::size_t first, std::span<const double> values);
  std::size_t rows() const { return rows_.size(); }
  /// One more than the last column that a row reaches.
  std::size_t columns() const { return columns_; }
  std::size_t first(std::size_t i) const { return rows_[i].first; }
  std::size_t end(std::size_t i) const { return rows_[i].first + rows_[i].size; }
  std::span<const double> row(std::size_t i) const {
    return {values_.data() + rows_[i].start, rows_[i].size};
  }
  /// So many columns, counted back from the last one that it or a row before it reaches, a row
  /// reaches at most.
  std::size_t window() const { return window_; }
  /// These rows, of all the columns.
  BandMatrix of_rows(std::span<const std::size_t> rows) const;

 private:
  struct Row {
    std::uint32_t start, first, size;  // start in values_
  };
  std::vector<Row> rows_;
  std::vector<double> values_;
  std::size_t columns_ = 0, window_ = 0;
};

}  // namespace rolling
