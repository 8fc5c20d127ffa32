// SPDX-License-Identifier: GPL-3.0-or-later
// Whitening: a linear map that makes correlated noise white.
#pragma once

#include "noise/band_matrix.h"

namespace rolling {

/// The covariance E E^T of the noise that E makes from white noise of variance one: a band matrix.
struct Covariance {
  /// The covariance of the first `rows` residuals.
  Covariance(const BandMatrix& E, std::size_t rows);
  explicit Covariance(const BandMatrix& E) : Covariance(E, E.rows()) {}

  std::size_t n, band;       // number of rows, and width of the upper band
  std::vector<double> rows;  // row k holds columns k .. k + band - 1
};

/// The Cholesky factor R of C = E E^T + F = R^T R, computed in O(n band^2) operations. The whitened
/// residuals are R^-T x. F is the covariance of white noise in addition to that of E: it is
/// diagonal, and its standard deviation is a share of that of each residual.
///
/// A share of band * sqrt(epsilon) is always there. Rounding changes C by up to band * epsilon
/// times the standard deviations of the two residuals in each of the elements of a row (Higham
/// 2002, Accuracy and Stability of Numerical Algorithms, theorem 10.3), so that smaller noise is
/// not known.
class Whitener {
 public:
  /// Throws Error for a residual without noise.
  Whitener(Covariance of_E, double share);
  /// Replaces X by R^-T X; X holds its columns one after another.
  void apply(std::span<double> X) const;
  /// Replaces x by R^-1 x.
  void apply_transposed(std::span<double> x) const;
  /// True if residual i has noise of its own: its standard deviation, given the residuals before
  /// it, is above 30 times that of F. If it is not, the residual is a linear combination of those
  /// before it.
  bool informative(std::size_t i) const {
    return R_[i * band_] * R_[i * band_] > 900 * white_ * variance(i);
  }
  /// Element i of the diagonal of E E^T.
  double variance(std::size_t i) const;
  /// ln det R.
  double log_size() const;

 private:
  std::size_t n_, band_;   // as in Covariance
  double white_;           // F is white_ times the diagonal of E E^T
  std::vector<double> R_;  // row k holds columns k .. k + band - 1
};

}  // namespace rolling
