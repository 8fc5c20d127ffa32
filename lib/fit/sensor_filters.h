// What residuals tell of filters: how much white noise they hold beside the noise that filters
// make, and whether speeds of which nothing is known are differences that the program of a sensor
// made of positions.
#pragma once

#include "fit/fitted.h"

namespace rolling {

/// A share of white noise, as in Noise.
struct WhiteShare {
  double share;
  double gain;  ///< of ln of the likelihood, over that of the share that it is compared with

  /// Noise without it gains as much once in a hundred records.
  bool decisive() const { return gain >= 3; }
};

/// The share between two numbers under which the residuals of a roll are most likely, its model
/// taken as linear around theta; `other` is the share that it is compared with. H of every run is
/// known.
WhiteShare most_likely_share(const std::shared_ptr<const RollModel>&,
                             const std::vector<double>& theta, double least, double most,
                             double other);

/// The fit through the positions of which the speeds are most likely differences: by the filter,
/// with some white noise added to what it makes, under which the residuals are most likely around
/// `plain`, a fit that knows of no filter. None if white noise alone is nearly as likely, or if the
/// residuals that it leaves do not look white.
std::optional<Fitted> fit_differences(const std::vector<FitRun>&, const FitOptions&,
                                      const Fitted& plain);

}  // namespace rolling
