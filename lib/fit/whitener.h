// Vectors of correlated noise made white.
#pragma once

#include "fit/band_matrix.h"

namespace rolling {

/// Turns vectors of covariance C = E E^T + floor^2 I into white ones, in O(n band^2), with no n x n
/// matrix: C = R^T R.
class Whitener {
 public:
  Whitener(const BandMatrix& E, double floor);
  void set_floor(const BandMatrix& E, double floor);  ///< another one, of the same E
  /// X becomes R^-T X, column by column, a column for each vector; a direction without noise
  /// becomes 0.
  void apply(std::span<double> X) const;
  void apply_transposed(std::span<double> x) const;  ///< x becomes R^-1 x
  double log_size() const;                           ///< ln of the determinant of R

 private:
  std::size_t n_, band_;
  std::vector<double> R_;                          ///< row k holds columns k .. k + band - 1
  void factor(const BandMatrix& E, double floor);  // C = R^T R, by Cholesky
  void triangulate(const BandMatrix& E,
                   double floor);  // E^T with floor I below it = Q R, by Givens
};

}  // namespace rolling
