// What a route hands to fit(): the minimum, and how the numbers that are reported depend on its
// parameters.
#pragma once

#include "fit/model_roll.h"

namespace rolling {

/// The floor of white noise in the weights, as a share of the noise of the median record (see
/// Noise). The model goes through the same filters as the data, so that the residuals are noise in
/// every direction; the floor covers what rounding adds to the columns. By simulation a larger one
/// loses precision where echoes are lost: 0.1 triples the spread of b for 20 % of them.
inline constexpr double floor_share = 1e-4;

/// A reported number and its derivatives by the parameters of its run and the shared ones (all zero
/// for one that is held fixed).
struct Quantity {
  double value;
  std::vector<double> gradient;
};

/// What the residuals of a fit with known filters tell of the noise of the raw column.
struct RawNoise {
  double variance;
  std::vector<double> sources;           ///< the least noise that explains the residuals
  std::vector<std::size_t> source_runs;  ///< the number of them in each run
  /// The weighted residuals that have noise of their own: white, if the noise of the raw column is.
  std::vector<double> innovations;
  std::vector<std::size_t> innovation_runs;
  std::size_t means_taken;  ///< see RollModel
};

struct Fitted {
  System system;  ///< weighted
  Minimum minimum;
  std::shared_ptr<const Noise> noise = std::make_shared<const Noise>();
  bool noise_inferred = false;  ///< by the residuals: then the weights are the inverse of their
                                ///< covariance
  double white_share = floor_share;        ///< the share of Noise
  std::optional<RawNoise> raw_noise = {};  ///< where another fit has told it
  double rss = 0;  ///< sum of the squares of model - data in the unit of the fitted column
  std::size_t records = 0, left_out = 0;
  Quantity a = {}, b = {};
  double bias_a = 0, bias_b = 0;                ///< of these values, as far as it is known
  std::optional<Quantity> slope = {};           ///< where it is a parameter
  std::vector<Quantity> v0 = {};                ///< one a run, if the model is a roll
  std::shared_ptr<const RollModel> rolls = {};  ///< the model, if it is a roll
  std::vector<double> v = {};  ///< speeds of the fitted records, if it is a law D(v)
};

/// The minimum by the loss that the options name. Throws Error for a robust one of noise that is
/// known to be correlated.
Minimum solve(const System&, const std::vector<double>& start, const FitOptions&,
              bool filters_known);

/// Throws Error when n records are too few for p parameters.
void require_records(std::size_t n, std::size_t p);

Fitted fit_route(Route, const std::vector<FitRun>&, const FitOptions&);

/// The records that a route can fit to a roll: all that are there. Those of a shift need no v > 0:
/// to choose by noisy speeds would choose by their noise.
std::vector<Rows> usable(Route, const std::vector<FitRun>&);

/// A fit of a roll: position, velocity, and shift with known filters (`making`). With `white_share`
/// the filters are inferred, and so much of their noise is white.
Fitted fit_rolls(Route, const std::vector<FitRun>&, std::vector<Rows>, Making, const FitOptions&,
                 std::optional<double> white_share = {});

/// The fit of one run of a fit of rolls by itself: the same records with the same weights, the
/// slope of the mat held at that of all runs.
Fitted fit_of_run(const Fitted& joint, std::size_t run, const FitOptions&);

}  // namespace rolling
