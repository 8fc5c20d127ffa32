// SPDX-License-Identifier: GPL-3.0-or-later
// The joint law of runs that were fitted by themselves, from their rows alone.
#pragma once

#include "fit/run_laws.h"

namespace rolling {

/// The fit of one run: its law with the errors of the noise, and the rms of its residuals, by which
/// the noise of runs is compared; 0 where it is not known. `OwnLaw::freedom` is the number of
/// degrees of freedom of rms; of many, about known_errors, where it is not known either.
struct LawRow {
  OwnLaw own;
  double rms = 0;
};
inline constexpr double known_errors = 1e6;

/// An error of ln a that rows have in common, as that of the shape factor of their body.
struct CommonError {
  double log_a;                   ///< the standard uncertainty of ln a
  std::vector<std::size_t> rows;  ///< the rows that have it, by their place
};

struct JointLaw {
  Pair law;              ///< ln a and b
  Symmetric covariance;  ///< common errors included
  Agreement agreement = {};
  double scatter_log_a = 0, scatter_b = 0;  ///< standard deviations beyond the noise
};

/// What agreement_of() makes of the runs themselves. Rows that agree have the
/// mean weighted by their inverse covariances; if the noise of all is of one size (Bartlett 1937 at
/// 1 %), that size is the common one, as in a joint fit. Rows that do not agree have the
/// ScatteredMean. Two or more rows, all with the same of a and b free.
JointLaw joint_law(std::vector<LawRow>, const std::vector<CommonError>&);

}  // namespace rolling
