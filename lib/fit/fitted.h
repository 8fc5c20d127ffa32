// The result of a route before its errors are computed: the minimum, and the reported numbers with
// their gradients with respect to the parameters.
#pragma once

#include "fit/model_roll.h"

namespace rolling {

/// The standard deviation of the white noise that the weights assume in addition to the filtered
/// noise, relative to that of the median record (see Noise). The model passes through the same
/// filters as the data, so that the residuals are noise in every direction; the white noise covers
/// the rounding of the columns. In simulations a larger value loses precision where echoes are
/// lost: 0.1 triples the scatter of b when 20 % are lost.
inline constexpr double floor_share = 1e-4;

/// A reported number and its gradient with respect to the parameters of its run, then the shared
/// ones (zero for a number that is held fixed).
struct Quantity {
  double value;
  std::vector<double> gradient;
};

/// The noise of the raw column, as estimated from the residuals of a fit with known filters.
struct RawNoise {
  double variance;                       ///< see noise_variance() in errors.h
  std::vector<double> sources;           ///< see Noise::explain()
  std::vector<std::size_t> source_runs;  ///< number of sources of each run
  /// The weighted residuals that are not determined by those before them (see
  /// Noise::innovations()); they are white if the noise of the raw column is white.
  std::vector<double> innovations;
  std::vector<std::size_t> innovation_runs;
  std::size_t means_taken;  ///< see RollModel::means_taken()
};

/// A minimum with what its errors need. fit(), compare_laws() and the other questions about a fit
/// start from it.
struct Fitted {
  System system;  ///< weighted
  Minimum minimum;
  std::shared_ptr<const Noise> noise = std::make_shared<const Noise>();
  bool noise_inferred = false;       ///< true if the filters were inferred from the residuals; the
                                     ///< weights are then the inverse of the covariance
  double white_share = floor_share;  ///< the share of Noise
  std::optional<RawNoise> raw_noise = {};  ///< if another fit has estimated it (loglog)
  double rss = 0;  ///< sum of squares of model - data in the unit of the fitted column
  std::size_t records = 0, left_out = 0;
  Quantity a = {}, b = {};
  double bias_a = 0, bias_b = 0;       ///< the expected bias of a and b; 0 where it is not known
  std::optional<Quantity> slope = {};  ///< if it is a parameter
  std::vector<Quantity> v0 = {};       ///< one for each run, if the model is a roll
  std::shared_ptr<const RollModel> rolls = {};  ///< the model, if it is a roll
  std::vector<double> v = {};  ///< speeds of the fitted records [m/s], if the model is a law D(v)
};

/// Minimises by the loss that the options name. Throws Error for the robust loss with known
/// filters, because filters spread an outlier over many records.
Minimum solve(const System&, const std::vector<double>& start, const FitOptions&,
              bool filters_known);

/// Throws Error if n records are too few for p parameters, or if p = 0.
void require_records(std::size_t n, std::size_t p);

/// Fits by one route, without the errors. Throws Error as fit() does, except for the limits on the
/// standard errors.
Fitted fit_route(Route, const std::vector<FitRun>&, const FitOptions&);

/// The records of each run that can be fitted to a roll: those with finite values. For shift, a
/// record with v <= 0 counts too: to select by noisy speeds would be to select by their noise.
std::vector<Rows> usable(Route, const std::vector<FitRun>&);

/// Fits a roll: position, velocity, and shift with known filters (`making`). `white_share` is given
/// if the filters were inferred from the residuals; it is then the share of Noise.
Fitted fit_rolls(Route, const std::vector<FitRun>&, std::vector<Rows>, Making, const FitOptions&,
                 std::optional<double> white_share = {});

/// Fits one run of a joint fit of rolls separately: the same records and weights, the slope of the
/// mat held at the joint value.
Fitted fit_of_run(const Fitted& joint, std::size_t run, const FitOptions&);

}  // namespace rolling
