// A matrix whose rows are zero outside a short stretch: what a filter does to a column.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rolling {

class BandMatrix {
 public:
  BandMatrix() = default;
  /// At least so many columns, though no row should reach the last of them.
  explicit BandMatrix(std::size_t columns) : columns_(columns) {}
  static BandMatrix identity(std::size_t n);
  bool is_identity() const;
  /// Makes room for so many rows of so many numbers in all.
  void reserve(std::size_t rows, std::size_t numbers);
  /// Appends a row; zeros at either end of it are not stored.
  void append(std::size_t first, std::span<const double> values);
  /// Appends row i of X times x plus row i of Y times y.
  void append(std::size_t i, double x, const BandMatrix& X, double y, const BandMatrix& Y);
  std::size_t rows() const { return first_.size(); }
  /// One more than the last column that a row reaches, or more.
  std::size_t columns() const { return columns_; }
  std::size_t first(std::size_t i) const { return first_[i]; }
  std::span<const double> row(std::size_t i) const {
    return {values_.data() + start_[i], start_[i + 1] - start_[i]};
  }
  /// Element i of the product with x.
  double times(std::size_t i, std::span<const double> x) const;
  /// The product of the transposed matrix with x.
  std::vector<double> transposed_times(std::span<const double> x) const;
  /// This matrix times B.
  BandMatrix operator*(const BandMatrix& B) const;
  /// Without the first `before` and the last `after` rows.
  BandMatrix without(std::size_t before, std::size_t after) const;

 private:
  std::vector<std::size_t> first_, start_{0};
  std::vector<double> values_;
  std::size_t columns_ = 0;
};

}  // namespace rolling
