// SPDX-License-Identifier: GPL-3.0-or-later
// The covariance of the noise of the residuals, as far as it is known, and the weights that follow
// from it: they whiten the residuals.
#pragma once

#include "base/matrix.h"
#include "noise/band_matrix.h"

namespace rolling {

/// The covariance E E^T of the noise that E makes from white noise of variance one: a band matrix.
struct Covariance {
  explicit Covariance(const BandMatrix& E);

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

/// White noise that did not pass the filters of its columns.
struct AddedNoise {
  double share = 0;       ///< its standard deviation as a share of that of each residual (Whitener)
  bool inferred = false;  ///< it and the filters were inferred from residuals
};

/// The noise of the residuals of each run is E times white noise of one unknown variance. The
/// elements of that white noise are called sources; for known filters they are the noise of the raw
/// rows.
class Noise {
 public:
  /// An unknown covariance: the residuals have no weights.
  Noise() = default;
  /// The weight matrix is the inverse of E E^T + F, where F is the covariance of the added noise.
  explicit Noise(std::vector<Filters> E, AddedNoise added = {});

  bool known() const { return !E_.empty(); }
  const AddedNoise& added() const { return added_; }
  /// True if the covariance is known and no noise was added to that of the sources.
  bool from_sources_alone() const { return known() && added_.share == 0; }
  const Whitener& whitener(std::size_t run) const { return whiteners_[run]; }

  /// (W E)^T x, one number for each source, run by run, for one number x for each residual. For the
  /// weighted residuals f these are the sources of least norm that explain f. B consists of these
  /// columns for Q = J R^-1 of a fit with these weights: the error of the parameters is -R^-1 B^T
  /// e, with e the noise of the sources, whatever the weights are.
  std::vector<double> to_sources(std::vector<double> x) const;
  /// The innovations: the weighted residuals that the residuals before them do not determine (see
  /// Whitener::informative()), and in `runs` their number in each run.
  std::vector<double> innovations(const std::vector<double>& f,
                                  std::vector<std::size_t>& runs) const;
  /// The number of innovations of all runs.
  std::size_t informative() const;
  /// The number of sources of each run.
  const std::vector<std::size_t>& sources() const { return sources_; }

 private:
  std::vector<Filters> E_;
  std::vector<Whitener> whiteners_;
  std::vector<std::size_t> rows_, sources_;  // numbers of each run
  AddedNoise added_;
};

}  // namespace rolling
