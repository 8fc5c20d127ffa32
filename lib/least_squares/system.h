// SPDX-License-Identifier: GPL-3.0-or-later
// A nonlinear least-squares problem of several runs, in the form that the minimisers need.
#pragma once

#include <cstddef>
#include <functional>
#include <numeric>
#include <span>
#include <vector>

namespace rolling {

/// A callback that receives the residuals f of a run (model - data, weighted; n numbers) and J =
/// df/dtheta, stored column by column: the parameters of that run, then the shared ones. It may
/// overwrite both.
using TakeRows = std::function<void(std::size_t run, std::span<double> f, std::span<double> J)>;

/// Residuals of several runs. Each run has `own` parameters; all runs have `shared` parameters in
/// common. theta holds the own parameters run by run, then the shared ones, scaled to order one. An
/// Error thrown by evaluate means that theta is not allowed; the search then takes a shorter step.
struct System {
  std::vector<std::size_t> runs;  ///< number of residuals of each run
  std::size_t own, shared;
  /// Passes the residuals at theta to the callback, run by run.
  std::function<void(const std::vector<double>& theta, const TakeRows&)> evaluate;

  std::size_t columns() const { return own + shared; }  ///< columns of J
  std::size_t parameters() const { return runs.size() * own + shared; }
  /// The place in theta of this column of the J of a run.
  std::size_t place(std::size_t run, std::size_t column) const {
    return column < own ? run * own + column : (runs.size() - 1) * own + column;
  }
  std::size_t residuals() const {
    return std::accumulate(runs.begin(), runs.end(), std::size_t{0});
  }
};

}  // namespace rolling
