// The covariance of the noise of the residuals, as far as it is known, and the weights that follow
// from it.
#pragma once

#include "noise/whitener.h"

#include <memory>

namespace rolling {

/// The standard deviation of the white noise that the weights assume in addition to the filtered
/// noise, relative to that of the median record. The model passes through the same filters as the
/// data, so that the residuals are noise in every direction; the white noise covers the rounding of
/// the columns. In simulations a larger value loses precision where echoes are lost: 0.1 triples
/// the scatter of b when 20 % are lost.
inline constexpr double floor_share = 1e-4;

/// The noise of the residuals of each run is E times white noise of one unknown variance. The
/// elements of that white noise are called sources; for known filters they are the noise of the raw
/// records.
class Noise {
 public:
  /// An unknown covariance: the residuals have no weights.
  Noise() = default;
  /// The weight matrix is the inverse of E E^T + (share s)^2 I, with s the norm of the median row
  /// of E. The second term bounds the weight of directions in which the filters leave almost no
  /// noise, where otherwise a small misfit of the model would dominate. `inferred`: E and the share
  /// were inferred from residuals, and the weights are the inverse of the covariance.
  Noise(std::vector<FilterMatrix> E, double share, bool inferred);

  bool known() const { return !E_.empty(); }
  double share() const { return share_; }
  bool inferred() const { return inferred_; }
  const Whitener& whitener(std::size_t run) const { return whiteners_[run]; }
  /// The unweighted residuals W^-1 f of all runs; W^T W is the weight matrix.
  std::vector<double> without_weights(const std::vector<double>& f) const;

  /// B = (W E)^T Q for Q = J R^-1 of a fit with these weights (one row of `columns` numbers for
  /// each residual): one row for each source, run by run. The error of the parameters is -R^-1 B^T
  /// e, with e the noise of the sources, whatever the weights are.
  std::vector<double> through(std::vector<double> Q, std::size_t columns) const;
  /// The meat B^T B of the sandwich covariance of each run, run after run.
  std::vector<double> meat(std::vector<double> Q, std::size_t columns) const;
  /// tr W E E^T W^T: the expected weighted sum of squares for sources of variance one without a
  /// fit.
  double trace() const;
  /// The noise of the sources of least norm that explains the weighted residuals f of all runs.
  std::vector<double> explain(std::vector<double> f) const;
  /// The innovations: the weighted residuals that the residuals before them do not determine (see
  /// Whitener::informative()), and in `runs` their number in each run.
  std::vector<double> innovations(const std::vector<double>& f,
                                  std::vector<std::size_t>& runs) const;
  /// The number of sources of each run.
  const std::vector<std::size_t>& sources() const { return sources_; }

 private:
  std::vector<FilterMatrix> E_;
  std::vector<Whitener> whiteners_;
  std::vector<std::size_t> rows_, sources_;  // numbers of each run
  double share_ = floor_share;
  bool inferred_ = false;
};

/// The Euclidean norm of each row without the border.
std::vector<double> row_norms(const FilterMatrix&);

}  // namespace rolling
