// SPDX-License-Identifier: GPL-3.0-or-later
// What the residuals of a fit show beside the law: an eccentric body, by a signal of period one
// turn; single readings far off the motion.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fit/fitted.h"
#include "fit/result.h"

namespace rolling {

/// The way and the speed of the fitted roll at the times of a run.
using Path = std::vector<std::array<double, 2>>;
Path path_of(const Fitted&, std::size_t run);

/// The eccentricity from the periodogram of Lomb (1976, Astrophys. Space Sci. 39, 447) and Scargle
/// (1982, Astrophys. J. 263, 835) of the residuals over x, at the one period 2 pi R. Sine and
/// cosine of x/R are shifts; they are carried through the equation of motion (A = 1, as if the
/// speed were steady in a turn) and through the filters of the data, and made orthogonal to the
/// columns of Q (uncertainty.h), because the fit can follow those. The noise before the filters is
/// assumed white, of its own size in each run.
///
/// The result is the run with the smallest p. It is empty if no run reaches 1 % (after Bonferroni's
/// correction), or if the period 0.7 or 1.4 times as long has as small a p: the residuals then have
/// another cause. A run of less than one turn, or with less than two rows in a turn, is not tested.
std::optional<Eccentricity> eccentricity_of(const Fitted&, const Matrix& Q);

/// The largest jump of the clock of a run that is fitted by itself, as where a camera has lost
/// frames: behind it the positions are those of a later time, and the residuals have the form of
/// the speed. The test is by F, after Bonferroni's correction for the rows; jumps are taken out one
/// after another, up to five. The result is empty unless the clock jumps by half a step or more and
/// white noise is left. Q: see eccentricity_of(). For positions without known filters.
std::optional<ClockJump> jump_of_clock(const Fitted&, const Matrix& Q);

/// The standard deviation of the times [s] if their noise, which is one of positions as large as
/// the speed, makes the noise of the residuals uneven, and no other noise is left uneven; else 0.
double noise_of_clock(const Fitted&);

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
/// the run where that is most; the count is 0 where none is. `robust`: the fit is the robust roll.
OffReadings off_readings(Fitted, bool robust);

}  // namespace rolling
