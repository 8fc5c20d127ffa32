// A matrix whose rows are zero outside a short stretch: what a filter does to a column.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rolling {

class BandMatrix {
 public:
  static BandMatrix identity(std::size_t n);
  void append(std::size_t first,
              std::span<const double> values);  ///< zeros at either end are not kept
  /// Appends x row i of X + y row i of Y.
  void append(std::size_t i, double x, const BandMatrix& X, double y, const BandMatrix& Y);
  std::size_t rows() const { return first_.size(); }
  std::size_t first(std::size_t i) const { return first_[i]; }
  std::span<const double> row(std::size_t i) const {
    return {values_.data() + start_[i], start_[i + 1] - start_[i]};
  }
  double times(std::size_t i,
               std::span<const double> x) const;  ///< element i of the product with x
  /// This matrix times B.
  BandMatrix operator*(const BandMatrix& B) const;
  BandMatrix without(std::size_t before, std::size_t after) const;  ///< the first and the last rows

 private:
  std::vector<std::size_t> first_, start_{0};
  std::vector<double> values_;
};

}  // namespace rolling
