// How much white noise residuals hold beside the noise that filters make.
#pragma once

#include "fit/model_roll.h"

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

}  // namespace rolling
