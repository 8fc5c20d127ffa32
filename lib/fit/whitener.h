// Vectors of correlated noise made white.
#pragma once

#include "fit/filter_matrix.h"

namespace rolling {

/// The covariance E E^T of what E makes of white noise of size one: a band matrix, bordered by a
/// last row and column where a last row of E reaches over the whole run.
struct Covariance {
  explicit Covariance(const FilterMatrix& E);
  /// The norm of the median row of E, but for the last one.
  double median_norm() const;

  std::size_t n, band;         // of the rows without the border
  std::vector<double> rows;    // row k holds columns k .. k + band - 1
  std::vector<double> border;  // above its corner; empty: there is none
  double corner = 0;
};

/// The Cholesky factor of C = E E^T + floor^2 I = R^T R, in O(n band^2) steps. The border has no
/// floor.
class Whitener {
 public:
  /// floor > 0; it must not be so small against the largest row of E that its square drowns in
  /// rounding.
  Whitener(Covariance of_E, double floor);
  /// Makes the rows of a matrix white, one after another: X becomes R^-T X.
  class Pass;
  /// X becomes R^-T X, column by column, a column for each vector.
  void apply(std::span<double> X) const;
  /// X, of `columns` numbers a row, becomes R^-1 X.
  void apply_transposed(std::span<double> X, std::size_t columns = 1) const;
  /// The vector that apply() has made f of.
  std::vector<double> undo(std::span<const double> f) const;
  /// Whether an element of R^-T x is more than what the floor makes of it: where it is not, the
  /// residual is a sum of those before it.
  bool informative(std::size_t i) const { return i >= n_ || R_[i * band_] > 30 * floor_; }
  /// ln of the determinant of R.
  double log_size() const;
  /// The trace of R^-T E E^T R^-1: the number of residuals less what the floor takes.
  double trace() const;
  /// Q^T R^-T E E^T R^-1 Q, for Q of `columns` numbers a row, which is overwritten.
  std::vector<double> middle(std::span<double> Q, std::size_t columns) const;

 private:
  double trace_of_inverse() const;
  std::size_t rows() const { return n_ + (corner_ > 0); }

  std::size_t n_, band_;  // of the rows without the border
  double floor_;
  std::vector<double> R_;       // row k holds columns k .. k + band - 1
  std::vector<double> border_;  // column of R above the corner
  double corner_ = 0;           // 0: no border
};

class Whitener::Pass {
 public:
  /// `stride` numbers a row, an even number.
  Pass(const Whitener&, std::size_t stride);
  void push(double* row);

 private:
  const Whitener& by_;
  std::size_t stride_, k_ = 0, base_ = 0;
  std::vector<double> later_;  // what the rows so far take from rows base and behind
  std::vector<double> along_border_;
};

}  // namespace rolling
