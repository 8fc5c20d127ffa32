// SPDX-License-Identifier: GPL-3.0-or-later
// The white noise that the residuals of a roll hold in addition to the filtered noise: rounding.
#pragma once

#include "fit/levels.h"
#include "fit/model_roll.h"

namespace rolling {

/// An estimate of the share of white noise (the share of Noise).
struct WhiteShare {
  double share;
  double likelihood;  ///< ln of it, comparable with restricted_likelihood() under other noise
  double gain;        ///< ln of the likelihood ratio to no white noise

  /// Noise without additional white noise reaches this gain in about 1 % of the runs.
  bool decisive() const { return gain >= levels::likely; }
};

/// The search for the share of white noise uses at most this many rows from the beginning of
/// each run. They show a share that is larger than the noise which the filters leave of their
/// slowest motion, about 1e-4 of the noise of a run.
inline constexpr std::size_t searched_for_white_noise = 100'000;

/// The share between `least` and `most` with the largest restricted likelihood of the residuals,
/// with the model linear around theta. H of every run must be known.
WhiteShare most_likely_share(const std::shared_ptr<const RollModel>&,
                             const std::vector<double>& theta, double least, double most);

}  // namespace rolling
