// SPDX-License-Identifier: GPL-3.0-or-later
// What the residuals of a fit show beside the law: an eccentric body, by a signal of period one
// turn; single readings far off the motion; a body that does not roll freely from the first row on.
#pragma once

#include <optional>

#include "fit/fit.h"
#include "fit/fitted.h"

namespace rolling {

/// The eccentricity from the periodogram of Lomb (1976, Astrophys. Space Sci. 39, 447) and Scargle
/// (1982, Astrophys. J. 263, 835) of the residuals over x, at the one period 2 pi R. Sine and
/// cosine of x/R are shifts; they are carried through the equation of motion (A = 1, as if the
/// speed were steady in a turn) and through the filters of the data, and made orthogonal to the
/// columns of Q (errors.h), because the fit can follow those. The noise before the filters is
/// assumed white, of its own size in each run.
///
/// The result is the run with the smallest p. It is empty if no run reaches 1 % (after Bonferroni's
/// correction), or if the period 0.7 or 1.4 times as long has as small a p: the residuals then have
/// another cause. A run of less than one turn, or with less than two rows in a turn, is not tested.
std::optional<Eccentricity> eccentricity_of(const Fitted&, const Matrix& Q);

/// The probability that white noise turns back as few of the steps from reading to reading, against
/// the motion of the fitted roll, as these readings do. A median of readings turns back hardly any,
/// and leaves hardly an autocorrelation where the body moves faster than its noise from row to row.
/// The number is taken as Poisson's, of the sum of the chances of the steps; neighbours exclude
/// each other, which makes few less likely than that. 1 where noise is known by its filters, and
/// for laws that are no roll.
double few_reversals(const Fitted&);

/// The readings of a roll that lie ten standard deviations off the motion of the others or further:
/// one after another the reading with the largest residual, studentised by its leverage, is left
/// out of the variance, up to a tenth of the run, and those up to the last that is so far off count
/// (Rosner 1983, Technometrics 25, 165): a burst does not hide behind itself. Where one is far off,
/// the readings are compared with the robust roll, since they bend the least-squares one. For known
/// filters the readings are those of the raw column. Returns the reading that is furthest off, of
/// the run where that is most; the count is 0 where none is.
OffReadings off_readings(const Fitted&);
/// The same of a fit that is robust itself.
OffReadings off_readings_of_robust(const Fitted&);

/// A disturbed beginning: the first rows of a run do not follow the motion of the other ones,
/// because of a hand that still pushes or of sliding.
struct Beginning {
  std::size_t run;   ///< the number of the run, from 0
  std::size_t rows;  ///< number of disturbed rows
  double time;       ///< from the first disturbed row to the first undisturbed one [s]
  double p;          ///< the probability that noise alone gives such rows
};

/// Chow's predictive test (1960, Econometrica 28, 591) asks whether the first 3, 5, 8, 13, ...
/// rows of a run (at most a quarter of it) agree with the prediction from the others. Each run
/// is fitted by itself (the slope of the mat fixed at that of all), as the law of a joint fit has
/// errors from the noise of the other runs, which may be larger. The statistic is the F ratio of
/// the reduction of the sum of squares that their removal causes to the variance of the noise: that
/// of the other residuals, or of the first k + 5 by their second differences where that is larger.
/// (The noise may differ along a run; the deviation that a hand leaves is smooth.) The result is
/// the run with the smallest p, if this is below 0.1 % after Bonferroni's correction and
/// the other residuals of that run are white: noise of long memory would deviate everywhere.
///
/// Runs of fewer than 20 rows more than parameters are left out. The result is empty for a
/// robust fit and one that is not a roll, and for filtered columns: filters spread a disturbance
/// over all residuals, which then are not white. Throws Error if the joint fit is not possible.
std::optional<Beginning> disturbed_beginning(Route, const std::vector<Run>&, const FitOptions&);

}  // namespace rolling
