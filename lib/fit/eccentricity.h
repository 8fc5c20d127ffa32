// SPDX-License-Identifier: GPL-3.0-or-later
// A test for an eccentric body: a signal of period one turn in the residuals of a fitted roll.
#pragma once

#include "fit/fitted.h"
#include "fit/result.h"

namespace rolling {

/// The eccentricity from the periodogram of Lomb (1976, Astrophys. Space Sci. 39, 447) and Scargle
/// (1982, Astrophys. J. 263, 835) of the residuals over x, at the one period 2 pi R. Sine and
/// cosine of x/R are shifts; they are carried through the equation of motion (to first order around
/// the fitted roll, A = 1) and through the filters of the data, and made orthogonal to the columns
/// of the Jacobian, because the fit can follow those. The noise before the filters is assumed
/// white, of its own size in each run; `variance` is that of all runs.
///
/// The result is the run with the smallest p. It is empty if no run reaches 1 % (after
/// Bonferroni's correction), or if the period 0.7 or 1.4 times as long has as small a p: the
/// residuals then have another cause. A run of less than one turn, or with less than two rows in
/// a turn, is not tested.
std::optional<Eccentricity> eccentricity_of(const Fitted&, double variance);

}  // namespace rolling
