// A least-squares problem of several runs, as the minimisers see it.
#pragma once

#include <cstddef>
#include <functional>
#include <numeric>
#include <span>
#include <vector>

namespace rolling {

/// Takes the next residuals f (model - data, weighted) of a run, and J = df/dtheta column by
/// column: of the parameters of that run, then of the shared ones. It may write over both.
using TakeRows = std::function<void(std::size_t run, std::span<double> f, std::span<double> J)>;

/// Residuals of several runs. Each run has `own` parameters beside the `shared` ones of all; theta
/// holds the former run by run, then the latter. Parameters should be of order one. An Error from
/// evaluate means that theta is not allowed, and the search backs off.
struct System {
  std::vector<std::size_t> runs;  ///< number of residuals of each
  std::size_t own, shared;
  /// Hands over the residuals in their order.
  std::function<void(const std::vector<double>& theta, const TakeRows&)> evaluate;

  std::size_t columns() const { return own + shared; }  ///< of J
  std::size_t parameters() const { return runs.size() * own + shared; }
  std::size_t residuals() const {
    return std::accumulate(runs.begin(), runs.end(), std::size_t{0});
  }
};

}  // namespace rolling
