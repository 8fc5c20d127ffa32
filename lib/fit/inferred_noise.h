// SPDX-License-Identifier: GPL-3.0-or-later
// What residuals tell of noise that no line names: speeds that the software of a sensor has made as
// differences of positions, and white noise that rounding has added behind filters.
#pragma once

#include "fit/fitted.h"
#include "statistics/levels.h"
#include "fit/model.h"

namespace rolling {

/// The velocity fit with the difference filter of options.possible_filters, and the share of white
/// noise, that have the largest restricted likelihood; the likelihood is computed around `plain`, a
/// fit without a filter. None if white noise alone, or a mean of speeds, is nearly as likely or
/// more likely, or if the residuals of the new fit are not white or are uneven along the runs.
std::optional<Fitted> fit_differences(const std::vector<FitRun>&, const FitOptions&,
                                      const Fitted& plain);

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
WhiteShare most_likely_share(const std::shared_ptr<const Model>&, const std::vector<double>& theta,
                             double least, double most);

}  // namespace rolling
