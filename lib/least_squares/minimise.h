// SPDX-License-Identifier: GPL-3.0-or-later
// Nonlinear least squares of several runs, to the limit of rounding: Levenberg-Marquardt steps,
// then Gauss-Newton steps. Each step comes from a QR decomposition of the Jacobian. And fits in
// which outliers count little or nothing.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <span>
#include <vector>

#include "least_squares/triangles.h"

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
  /// True where the least sum of squares is wanted to a thousandth of the variance of the noise
  /// alone: the search ends there, and is given up sooner.
  bool rough = false;

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

/// The residuals f at theta, and J = Q R there. R and not J^T J, because the condition number of
/// the normal equations is the square of that of J.
struct Minimum {
  std::vector<double> theta, f = {};
  Triangles R = {};
  double rss = INFINITY;  ///< |f|^2
};

/// The minimum that the search finds from `start`. Throws Error if the search does not converge or
/// if the Jacobian is rank-deficient.
Minimum minimise(const System&, const std::vector<double>& start);

/// The same for one start of several: a smaller minimum takes the place of `best`, which stays
/// where the search finds none.
void improve(Minimum& best, const System&, const std::vector<double>& start);

/// f and R at theta, which need not be a minimum; rss is infinite, and the rest empty, where the
/// model has no finite values.
Minimum tried(const System&, std::vector<double> theta);

/// The same; throws Error where the model has no finite values.
Minimum evaluated(const System&, std::vector<double> theta);

/// The largest change of a parameter in a step, relative to its size where that is above 1.
double relative_size(const std::vector<double>& step, const std::vector<double>& theta);

/// theta + step.
std::vector<double> moved(std::vector<double> theta, const std::vector<double>& step);

/// Minimises Tukey's bisquare loss (constant 4.685: 95 % efficiency for normal noise) by
/// iteratively reweighted least squares, starting from the minimum of Huber's loss (1.345, the same
/// efficiency). The scale of each run is the median size of its residuals in the latter: the loss
/// is the sum of s^2 rho(f/s), with the s of the run, and without outliers that of plain squares.
/// Of a run of at most 1000 residuals and 12 parameters, outliers of the least trimmed squares
/// do not count in Huber's loss: few outliers could draw its minimum to them. The f of the result
/// are pseudo-residuals (Huber 1981, Robust Statistics, section 7.6) and R is unweighted, so that
/// the least-squares formulas for the errors, applied to them, give the errors of the robust fit.
/// The residuals must be those of single rows, with independent noise.
/// The search of longer runs begins at the first start.
Minimum minimise_robust(const System&, const std::vector<std::vector<double>>& starts);

/// The system that is linear in its parameters, which are 0 at theta, with the residuals and the J
/// that this one has there.
System linearised(const System&, const std::vector<double>& theta);

/// The system whose residuals are multiplied by these factors. It refers to both.
System weighted(const System&, const std::vector<double>& factors);

/// ln of the restricted likelihood (Patterson and Thompson 1971, Biometrika 58, 545) of normal
/// white residuals, up to a constant, with the model linear around theta: -(n - p)/2 ln RSS - ln
/// |det R|.
double restricted_likelihood(const Minimum& at);

}  // namespace rolling
