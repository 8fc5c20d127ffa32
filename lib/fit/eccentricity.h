// Does the body run true? What repeats once a turn in the residuals of a fitted roll.
#pragma once

#include "fit/fitted.h"

namespace rolling {

/// What the period 2 pi R explains of the residuals: the periodogram of Lomb (1976, Astrophys.
/// Space Sci. 39, 447) and Scargle (1982, Astrophys. J. 263, 835) over x at this one period, where
/// sine and cosine are first carried through the equation of motion (to first order around the
/// fitted roll, A = 1) and the filters of the data, and freed of what the parameters of the fit can
/// follow. For sine and cosine of the records of a body of steady speed it is theirs. The noise is
/// taken as white before the filters, of this variance. Of records that are dense against a turn,
/// means of neighbours are looked at.
///
/// None if no run shows it at 1 % (after Bonferroni), or another period near by explains as much:
/// then it is something else that the law does not follow. Runs of less than one
/// turn, or with less than two records a turn, are not looked at.
std::optional<Eccentricity> eccentricity_of(Route, const std::vector<FitRun>&, const Fitted&,
                                            double variance);

}  // namespace rolling
