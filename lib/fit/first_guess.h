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

}  // namespace rolling
