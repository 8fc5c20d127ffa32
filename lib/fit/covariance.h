// How the noise of the fitted records hangs together: known from the filters that were applied, or
// judged from the residuals.
#pragma once

#include "fit/band_matrix.h"
#include "fit/filter.h"
#include "fit/whitener.h"

#include <map>
#include <string>

namespace rolling {

/// The matrix of a filter on these times, found by feeding it combs of unit impulses.
BandMatrix probe(const LinearFilter&, std::span<const double> t);

/// What a chain makes of the noise of its one raw column.
struct NoiseResponse {
  std::string source;     ///< the raw column, whose noise is taken as white
  std::vector<double> t;  ///< times of the raw records: the run's, and those that were cut away
                          ///< after filters had used them
  std::map<std::string, BandMatrix> of;  ///< each column, the source included, as a linear map of
                                         ///< the source; a row for each record of the run
};
/// Records that were cut away are taken as spaced like those at that end. Throws Error for a chain
/// that starts from more than one raw column.
NoiseResponse noise_response(const FilterChain&, std::span<const double> t);

/// The noise of the residuals of several runs, E times white noise of one unknown size.
class KnownNoise {
 public:
  /// `share` of the median record's noise is taken as white floor when residuals are weighted (not
  /// in their covariance).
  void append(BandMatrix E, double share);
  /// Weights with another share.
  void set_floor(double share);
  /// Standard deviation of further noise of each residual, white and of known size; none if empty.
  /// It is not reckoned with in the weights.
  std::vector<double> own;
  bool empty() const { return runs_.empty(); }
  /// Weights all residuals of a run, and their derivatives column by column.
  void weight(std::size_t run, std::span<double> f, std::span<double> J) const;
  /// ln of the factor by which weighting shrinks a volume.
  double log_size() const;
  /// Standard deviation of each residual for white noise of size one.
  std::vector<double> sizes() const;
  /// The variance of that white noise, from the weighted residuals and Q = J R^-1 of the fit, with
  /// its shared columns.
  double variance(const std::vector<double>& f, const std::vector<double>& Q,
                  std::size_t shared) const;
  /// The middle of the covariance R^-1 M R^-T of parameters that were fitted with weight(), run by
  /// run, from the weighted residuals and Q = J R^-1 of the fit, with its shared columns; true
  /// whatever the weights.
  std::vector<double> middle(const std::vector<double>& f, const std::vector<double>& Q,
                             std::size_t shared) const;

 private:
  struct Run {
    BandMatrix E;
    std::size_t sources;
    double median;  // of the norms of E's rows
    Whitener whitener;
  };
  std::vector<Run> runs_;
};

/// Significance of the autocorrelation of the residuals of p parameters by Ljung and Box (1978),
/// Biometrika 65, 297, over one lag or over min(10, n/10), whichever shows more: small where they
/// are not white. The p/n that the fit takes off each correlation is added again. `runs` tells how
/// many residuals each run has.
double ljung_box(std::span<const double> residuals, std::size_t p,
                 std::span<const std::size_t> runs);

/// Sum of the products of residuals `lag` records apart within the runs.
double lagged(std::span<const double> residuals, std::span<const std::size_t> runs,
              std::size_t lag);

/// The middle of the sandwich, sum of w(|i-j|) u_i u_j^T over each run, row by row, run by run; u
/// are n rows of scores, for the columns of each run, of p parameters in all. Bartlett weights
/// (Newey and West 1987, Econometrica 55, 703), bandwidth by Andrews' AR(1) rule (1991,
/// Econometrica 59, 817), after prewhitening by the residuals' own AR(1) (Andrews and Monahan 1992,
/// Econometrica 60, 953), corrected for the fit: short records need both.
std::vector<double> newey_west(std::span<const double> scores, std::size_t p,
                               std::span<const double> residuals,
                               std::span<const std::size_t> runs);

}  // namespace rolling
