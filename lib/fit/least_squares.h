// Nonlinear least squares to round-off: Levenberg-Marquardt, finished by Gauss-Newton steps, each
// from a QR of the Jacobian.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace rolling {

/// Takes residuals f (model - data, whitened where their covariance is known) of one run, those
/// after the ones that it has taken, and J = df/dtheta, column by column: of the parameters of that
/// run, then of the shared ones. It may write over both.
using TakeRows = std::function<void(std::size_t run, std::span<double> f, std::span<double> J)>;

/// Residuals of several runs, each with `own` parameters of its own beside `shared` ones of all:
/// theta holds the former run by run, then the latter. Parameters should be of order one. An Error
/// from evaluate means that theta is not allowed, and the search backs off.
struct System {
  std::vector<std::size_t> runs;  ///< residuals of each
  std::size_t own, shared;
  /// Hands over the residuals in their order.
  std::function<void(const std::vector<double>& theta, const TakeRows&)> evaluate;

  std::size_t columns() const { return own + shared; }  ///< of J
  std::size_t parameters() const { return runs.size() * own + shared; }
  std::size_t residuals() const;
  /// The place in theta of a column of J.
  std::size_t place(std::size_t run, std::size_t column) const {
    return column < own ? run * own + column : (runs.size() - 1) * own + column;
  }
};

struct Minimum {
  std::vector<double> theta, f;
  std::vector<double> R;  ///< J = Q R for the columns of each run: as many upper triangles, row by
                          ///< row, whose shared part is the same
  double rss;
};

/// Throws Error if there is no convergence, or if the parameters cannot be told apart.
Minimum minimise(const System&, const std::vector<double>& start);

/// theta of the minimum of a system that stands in for a larger one; the start if it has none.
std::vector<double> approach(const System&, std::vector<double> start);

/// minimise() with Tukey's bisquare loss (tuned for 95 % efficiency) by reweighting, from Huber's
/// on the way; the scale is the MAD of the residuals. What comes back are pseudo-residuals f (Huber
/// 1981, Robust Statistics, section 7.6) with the unweighted R, so that the errors of least squares
/// made from them are those of the robust fit. The scale must be that of single records: no
/// correlated noise.
Minimum minimise_robust(const System&, const std::vector<double>& start);

/// ln of the restricted likelihood (Patterson and Thompson 1971, Biometrika 58, 545) of residuals
/// that are normal and white, up to a constant, in the linear approximation around theta: -(n -
/// p)/2 ln RSS - ln det R, J = Q R.
double restricted_likelihood(const System&, const std::vector<double>& theta);

std::vector<double> residuals_at(const System&, const std::vector<double>& theta);

/// Q = J R^-1 (a row for each residual), in whose columns the covariance R^-1 M R^-T of the
/// parameters has its middle M.
std::vector<double> orthonormal(const System&, const Minimum&);

/// Sums of each run, one matrix for the columns of each, become those of all runs where both
/// columns are shared.
void add_shared(std::vector<double>& M, std::size_t columns, std::size_t shared);

/// The covariance of the parameters of a run and the shared ones is R^-1 M R^-T.
class Spread {
 public:
  Spread(std::vector<double> R, std::vector<double> M, std::size_t columns)
      : R_(std::move(R)), M_(std::move(M)), q_(columns) {}
  /// Covariance of two functions of the parameters of a run, by their gradients.
  double operator()(const std::vector<double>& g, const std::vector<double>& h,
                    std::size_t run = 0) const;

 private:
  std::vector<double> solve_transposed(std::vector<double> g, std::size_t run) const;
  std::vector<double> R_, M_;
  std::size_t q_;
};

}  // namespace rolling
