// Whitening: a linear map that makes correlated noise white.
#pragma once

#include "noise/filter_matrix.h"

namespace rolling {

/// The covariance E E^T of the noise that E makes from white noise of variance one: a band matrix,
/// with an additional last row and column (the border) if E has one.
struct Covariance {
  explicit Covariance(const FilterMatrix& E);
  /// The median norm of the rows of E without the border. Throws Error if there are none.
  double median_norm() const;

  std::size_t n, band;         // number of rows without the border, and width of the upper band
  std::vector<double> rows;    // row k holds columns k .. k + band - 1
  std::vector<double> border;  // the border above its corner; empty if there is none
  double corner = 0;
};

/// The Cholesky factor R of C = E E^T + floor^2 I = R^T R, computed in O(n band^2) operations. The
/// floor is not added to the border. The whitened residuals are R^-T x.
class Whitener {
 public:
  /// floor > 0. Relative to the largest row of E, floor^2 must be above the rounding error. Throws
  /// Error if C is not positive definite.
  Whitener(Covariance of_E, double floor);
  /// Replaces X by R^-T X row by row, for rows that come one after another.
  class Pass;
  /// Replaces X by R^-T X; X holds its columns one after another.
  void apply(std::span<double> X) const;
  /// Replaces X by R^-1 X; X is stored row by row, `columns` numbers in each row.
  void apply_transposed(std::span<double> X, std::size_t columns = 1) const;
  /// The vector R^T f, from which apply() made f.
  std::vector<double> undo(std::span<const double> f) const;
  /// True if residual i has noise of its own: its standard deviation, given the residuals before
  /// it, is above 30 floors. If it is not, the residual is a linear combination of those before it.
  bool informative(std::size_t i) const { return i >= n_ || R_[i * band_] > 30 * floor_; }
  /// ln det R.
  double log_size() const;
  /// tr R^-T E E^T R^-1: the number of residuals minus the contribution of the floor.
  double trace() const;
  /// Q^T R^-T E E^T R^-1 Q, for Q stored row by row with `columns` numbers in each row; overwrites
  /// Q.
  std::vector<double> meat(std::span<double> Q, std::size_t columns) const;

 private:
  double trace_of_inverse() const;
  std::size_t rows() const { return n_ + (corner_ > 0); }

  std::size_t n_, band_;  // as in Covariance
  double floor_;
  std::vector<double> R_;       // row k holds columns k .. k + band - 1
  std::vector<double> border_;  // the last column of R above the corner
  double corner_ = 0;           // 0 if there is no border
};

class Whitener::Pass {
 public:
  /// `stride`: the number of elements in a row, an even number.
  Pass(const Whitener&, std::size_t stride);
  void push(double* row);

 private:
  const Whitener& by_;
  std::size_t stride_, k_ = 0, base_ = 0;
  std::vector<double> later_;  // contributions of the rows so far to rows base_ and later
  std::vector<double> along_border_;
};

}  // namespace rolling
