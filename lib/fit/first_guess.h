// Where the search for a roll begins.
#pragma once

#include "fit/model_roll.h"

namespace rolling {

struct FirstGuess {
  Parameters parameters;  ///< with units that suit the data
  std::vector<double> theta;
};

/// From the runs as they stand, without filters (H): positions or speeds. Throws Error where they
/// show no roll.
FirstGuess first_guess(const std::vector<ObservedRun>&, const FitOptions&);

/// Means of neighbouring records in the place of long runs (without filters): at their minimum that
/// of all records is all but reached. No runs where there are few records.
std::vector<ObservedRun> means_of_many(const std::vector<ObservedRun>&);

}  // namespace rolling
