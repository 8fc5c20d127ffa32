// SPDX-License-Identifier: GPL-3.0-or-later
// The starting point for the fit of a roll.
#pragma once

#include "fit/model.h"

namespace rolling {

struct FirstGuess {
  Parameters parameters;  ///< with units v_ref and x_ref that suit the data
  /// theta; behind it others where a robust search may start as well.
  std::vector<std::vector<double>> starts;
};

/// Estimates theta from positions or speeds as if they were not filtered (without H). Throws Error
/// if the body does not move or if no law comes near the data.
FirstGuess first_guess(const std::vector<ObservedRun>&, const FitOptions&);

/// The runs averaged to at most 4096 block means each; their minimum is very close to that of all
/// rows. Empty if the runs have 4096 rows or fewer on average. The runs must have no H.
std::vector<ObservedRun> means_of_many(const std::vector<ObservedRun>&);

}  // namespace rolling
