// What is known of the noise of residuals, and the weights that follow from it.
#pragma once

#include "fit/whitener.h"

#include <memory>
#include <optional>

namespace rolling {

/// The residuals of each run are E times white noise of one unknown size.
class Noise {
 public:
  /// Nothing is known: no weights.
  Noise() = default;
  /// The weights are the inverse of E E^T + (share s)^2 I, s the norm of the median row of E: where
  /// the filters leave all but no noise, the misfit of the model would otherwise count without
  /// bound. Without a share there are no weights; the covariance is known all the same.
  Noise(std::vector<FilterMatrix> E, std::optional<double> share);

  bool known() const { return !E_.empty(); }
  bool weighted() const { return !whiteners_.empty(); }
  const Whitener& whitener(std::size_t run) const { return whiteners_[run]; }
  /// The residuals of all runs without their weights.
  std::vector<double> without_weights(const std::vector<double>& f) const;

  /// For Q = J R^-1 of a fit with these weights (a row of `columns` numbers for each residual):
  /// B = (W E)^T Q, a row for each source, run by run. The error of the parameters is
  /// -R^-1 B^T e, e the noise of the sources, whatever the weights.
  std::vector<double> through(std::vector<double> Q, std::size_t columns) const;
  /// B^T B of each run, one matrix after another.
  std::vector<double> middle(std::vector<double> Q, std::size_t columns) const;
  /// tr W E E^T W^T: what the weighted sum of squares would be on average for noise of size one if
  /// nothing were fitted.
  double trace() const;
  /// The least noise of the sources that explains the weighted residuals of all runs.
  std::vector<double> explain(std::vector<double> f) const;
  /// The weighted residuals that are more than what the floor makes of them, and how many they are
  /// in each run.
  std::vector<double> innovations(const std::vector<double>& f,
                                  std::vector<std::size_t>& runs) const;
  /// The number of sources of each run.
  std::vector<std::size_t> sources() const;

 private:
  template <typename Number, typename OfRun>
  std::vector<double> each(std::span<Number> all, std::size_t columns, OfRun&&) const;

  std::vector<FilterMatrix> E_;
  std::vector<Whitener> whiteners_;
};

/// The norm of each row, but of one that reaches over the run.
std::vector<double> row_norms(const FilterMatrix&);

}  // namespace rolling
