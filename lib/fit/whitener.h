// Vectors of correlated noise made white.
#pragma once

#include "fit/band_matrix.h"

namespace rolling {

/// The Cholesky factor of C = E E^T + floor^2 I = R^T R, a band matrix, in O(n band^2) steps. With
/// `border` the last row of E may reach over the whole run (the mean of a column): it has no floor,
/// and borders the band as a last row and column of C.
class Whitener {
 public:
  /// floor > 0; it must not be so small against the largest row of E that its square drowns in
  /// rounding.
  Whitener(const BandMatrix& E, double floor, bool border = false);
  /// X becomes R^-T X, column by column, a column for each vector.
  void apply(std::span<double> X) const;
  /// x becomes R^-1 x.
  void apply_transposed(std::span<double> x) const;
  /// Whether an element of R^-T x is more than what the floor makes of it: where it is not, the
  /// residual is a sum of those before it.
  bool informative(std::size_t i) const { return i >= n_ || R_[i * band_] > 30 * floor_; }
  /// ln of the determinant of R.
  double log_size() const;
  /// The trace of R^-T E E^T R^-1: the number of residuals less what the floor takes.
  double trace() const;

 private:
  double trace_of_inverse() const;

  std::size_t n_, band_;  // of the rows without the border
  double floor_;
  std::vector<double> R_;       // row k holds columns k .. k + band - 1
  std::vector<double> border_;  // column of R above the corner
  double corner_ = 0;           // 0: no border
};

}  // namespace rolling
