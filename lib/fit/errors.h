// The errors of the parameters. Whoever asks about an error bar looks here.
#pragma once

#include "fit/fitted.h"

namespace rolling {

/// The covariance R^-1 M R^-T of the parameters of each run and the shared ones.
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

struct Uncertainty {
  Errors kind;
  double whiteness;  ///< as in FitResult
  double variance;   ///< of the noise: of the raw column, where the filters are known
  Spread covariance;
};

/// The errors are those of the known filters (exact sandwich), or the classical ones. Where the
/// noise of 30 or more records is not white (Ljung-Box) they are those of its autocorrelation
/// (Newey-West), at 10 % already if neighbours go along; where it is of uneven size at 1 %, HC3.
/// For known filters the noise that is tested is that of the raw column.
Uncertainty uncertainty_of(const Fitted&);

/// What the noise brings to the errors of the numbers that are reported.
struct NoiseErrors {
  Errors kind;
  double whiteness;
  double a, b, together;  ///< standard errors, and the covariance of a and b
  double slope = 0;
  std::vector<double> v0 = {};  ///< of each run

  void multiply(double factor);
};
NoiseErrors noise_errors(const Fitted&, const Uncertainty&);

/// By how much one standard uncertainty of a given number moves what is fitted.
struct Moved {
  std::string by;  ///< "K", or "K 0.5" where the runs have several
  double a, b, slope;
  std::vector<double> v0;  ///< of each run
};

/// One for each number that is given with an uncertainty. Runs that state the same number with the
/// same uncertainty are runs of the same body: it moves them together. The records are fitted again
/// with the number a standard uncertainty (or a tenth of the number, if that is less) above and
/// below; on the routes by D, whose D was made with these numbers, with the D that the same
/// accelerations give then.
std::vector<Moved> moved_by_given(Route, const std::vector<FitRun>&, const FitOptions&,
                                  const Fitted&);

/// The variance of the noise of the raw column, where the filters are known.
double noise_variance(const Fitted&);

/// Q = J R^-1 (a row for each residual), in whose columns the covariance R^-1 M R^-T of the
/// parameters has its middle M.
std::vector<double> orthonormal(const System&, const Minimum&);

/// Sums of each run, one matrix for the columns of each, become those of all runs where both
/// columns are shared.
void add_shared(std::vector<double>& M, std::size_t columns, std::size_t shared);

/// Significance of the autocorrelation of the residuals of p parameters by Ljung and Box (1978),
/// Biometrika 65, 297, over one lag or over min(10, n/10), whichever is smaller. The p/n by which
/// the fit lowers each correlation is added again. `runs` holds the number of residuals of each
/// run.
double ljung_box(std::span<const double> residuals, std::size_t p,
                 std::span<const std::size_t> runs);

/// Significance of a trend in the size of the residuals along the runs, linear and quadratic in the
/// number of the record: the studentised test of Breusch and Pagan (Koenker 1981, J. Econometrics
/// 17, 107).
double breusch_pagan(std::span<const double> residuals, std::span<const std::size_t> runs);

/// Sum of the products of residuals `lag` records apart within the runs.
double lagged(std::span<const double> residuals, std::span<const std::size_t> runs,
              std::size_t lag);

/// The middle of the sandwich, sum of w(|i-j|) u_i u_j^T over each run, row by row, run by run; u
/// are n rows of scores, for the columns of each run; p numbers in all, the parameters and what
/// filters have taken, were fitted to the noise of the residuals. Bartlett weights
/// (Newey and West 1987, Econometrica 55, 703), bandwidth by Andrews' AR(1) rule (1991,
/// Econometrica 59, 817), after prewhitening by the AR(1) of the residuals (Andrews and Monahan
/// 1992, Econometrica 60, 953), corrected for the fit: short records need both.
std::vector<double> newey_west(std::span<const double> scores, std::size_t p,
                               std::span<const double> residuals,
                               std::span<const std::size_t> runs);

}  // namespace rolling
