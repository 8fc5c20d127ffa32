// Nonlinear least squares to round-off: GSL's Levenberg-Marquardt, finished by Gauss-Newton steps from a QR of the Jacobian.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace rolling {

/// n residuals f (model - data, whitened where their covariance is known) of p parameters, and J = df/dtheta, row by row.
/// Parameters should be of order one. An Error from evaluate means that theta is not allowed, and the search backs off.
struct System {
  std::size_t n, p;
  std::function<void(const std::vector<double>& theta, std::vector<double>& f, std::vector<double>& J)> evaluate;
};

struct Minimum {
  std::vector<double> theta, f, J;
  std::vector<double> R;  ///< J = Q R: p x p, upper triangle, row by row
  double rss;
};

/// Throws Error if there is no convergence, or if the parameters cannot be told apart.
Minimum minimise(const System&, const std::vector<double>& start);

/// The same with Tukey's bisquare loss (tuned for 95 % efficiency) by reweighting, from Huber's on the way; the scale is the MAD of the
/// residuals. What comes back are pseudo-residuals f (Huber 1981, Robust Statistics, section 7.6) with the unweighted J, so that the
/// errors of least squares made from them are those of the robust fit. The scale must be that of single records: no correlated noise.
Minimum minimise_robust(const System&, const std::vector<double>& start);

/// ln of the restricted likelihood (Patterson and Thompson 1971, Biometrika 58, 545) of residuals that are normal and white, up to a
/// constant, in the linear approximation around theta: -(n - p)/2 ln RSS - ln det R, J = Q R.
double restricted_likelihood(const System&, const std::vector<double>& theta);

/// Q = J R^-1 (n rows of p), in whose columns the covariance R^-1 M R^-T of the parameters has its middle M.
std::vector<double> orthonormal(const Minimum&);

/// The covariance of the parameters is R^-1 M R^-T.
class Spread {
 public:
  Spread(std::vector<double> R, std::vector<double> M, std::size_t p) : R_(std::move(R)), M_(std::move(M)), p_(p) {}
  /// Covariance of two functions of the parameters, by their gradients.
  double operator()(const std::vector<double>& g, const std::vector<double>& h) const;

 private:
  std::vector<double> solve_transposed(std::vector<double> g) const;
  std::vector<double> R_, M_;
  std::size_t p_;
};

}  // namespace rolling
