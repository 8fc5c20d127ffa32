// What the residuals say about filters: the white noise that they hold in addition to the filtered
// noise, and whether speeds of unknown origin are differences of positions.
#pragma once

#include "fit/fitted.h"

namespace rolling {

/// An estimate of the share of white noise (the share of Noise).
struct WhiteShare {
  double share;
  double gain;  ///< ln of the likelihood ratio to the share that it is compared with

  /// Noise without additional white noise reaches this gain in about 1 % of the records.
  bool decisive() const { return gain >= 3; }
};

/// The search for the share of white noise uses at most this many records from the beginning of
/// each run. They show a share that is larger than the noise which the filters leave of their
/// slowest motion, about 1e-4 of the noise of a record.
inline constexpr std::size_t searched_for_white_noise = 100'000;

/// The share between `least` and `most` with the largest restricted likelihood of the residuals,
/// with the model linear around theta, compared with the share `other`. H of every run must be
/// known.
WhiteShare most_likely_share(const std::shared_ptr<const RollModel>&,
                             const std::vector<double>& theta, double least, double most,
                             double other);

/// The velocity fit with the difference filter of options.possible_filters, and the share of white
/// noise, that have the largest restricted likelihood; the likelihood is computed around `plain`, a
/// fit without a filter. None if white noise alone, or a mean of speeds, is nearly as likely or
/// more likely, or if the residuals of the new fit are not white or are uneven.
std::optional<Fitted> fit_differences(const std::vector<FitRun>&, const FitOptions&,
                                      const Fitted& plain);

}  // namespace rolling
