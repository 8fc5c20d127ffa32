// SPDX-License-Identifier: GPL-3.0-or-later
// The search for the stop of a roll between the rows of its speed.
#pragma once

#include "fit/model_roll.h"
#include "least_squares/minimise.h"

namespace rolling {

/// The sum of the squares of speeds, as a function of the time T of the stop, has a cusp at each
/// row where b < 1/2: the speed just before the stop grows like (T - t)^(1/(1 - b)), whose
/// second derivative is unbounded. So the sum may have a minimum in each interval between two
/// rows, and Gauss-Newton steps do not leave it. This function starts the search again with T in
/// the interval of the minimum and in those beside it, the other parameters following T to first
/// order, until no such start leads to a smaller sum. Positions are smoother by one order, and
/// nothing is done.
///
/// The minima differ the less the more rows there are: above 2048 rows times runs nothing is
/// done.
Minimum beyond_cusps(const RollModel&, const System&, Minimum);

}  // namespace rolling
