// SPDX-License-Identifier: GPL-3.0-or-later
// What other fits of the same runs tell of a fit: whether the runs agree, what the input quantities
// (K, R, g and the slope that are given) bring to its errors, whether a beginning is disturbed.
#pragma once

#include <optional>
#include <vector>

#include "fit/result.h"
#include "fit/routes.h"
#include "fit/uncertainty.h"

namespace rolling {

/// Compares the runs of a joint fit. Each run is fitted by itself, with a and b of its own (the
/// slope of the mat is fixed at that of the joint fit); its law (ln a, b) is compared with the mean
/// of all, weighted by the inverse covariances of the runs' own errors. Its p is that of
/// the law with which all agree best. A second test compares the sums of squares of the runs under
/// the common law and under their own laws. It holds also if the model is curved over the errors of
/// a run; the runs disagree only if both tests say so. Returns nothing if fewer than two runs
/// determine a law by themselves, or if a and b are fixed.
///
/// `errors` are those of the joint fit. Where the runs agree, `errors` and `joint` stay as they
/// are. Where they disagree, the law of `joint` becomes that of the mean of b and of the mean of
/// ln D at the speed at which the runs know D best: one common law would bend between them, and 2 %
/// of scatter in a would shift b by its error. Values and errors are those of
/// statistics/random_effects.h. The law does not depend on the units.
///
/// A fitted slope of the mat becomes the one at which the runs of both directions agree best in
/// ln D, by the same weights, and takes a degree of freedom. Two runs then have none left, and runs
/// of one direction do not tell a slope by their scatter: a, b and the slope stay those of the
/// joint fit, and all errors are multiplied by the root of chi^2/dof.
std::optional<Agreement> agreement_of(Route, const std::vector<Run>&, const FitOptions&,
                                      Uncertainty& errors, Fitted& joint);

/// The joint fit of runs that are known to disagree, with the values that agreement_of() gives it.
Fitted fit_of_disagreeing(Route, const std::vector<Run>&, const FitOptions&);

/// The contribution of each input quantity (K, R, g, slope) that has an uncertainty. Runs with the
/// same value and uncertainty have the same body; they change together. The derivative is a central
/// difference of two fits, with the number one standard uncertainty (or a tenth of the number, if
/// that is less) above and below its value. On the routes that read D, which was computed with
/// these numbers, D is computed again from the same accelerations. Where the runs do not agree,
/// their law is that of their means (see agreement_of()) for the changed number too. If a alone
/// depends on the number, in proportion to (K + 1) R/g, nothing is fitted again. Throws Error if
/// the fit itself is not possible.
std::vector<ErrorShare> shares_of_inputs(Route, const std::vector<Run>&, const FitOptions&,
                                         const Fitted&, bool agree);

/// The coefficients, and the slope, whose interval of 1.96 standard errors of the noise is none. An
/// error is linearised; the sum of squares tells the truth. Each number is held at either end of
/// its interval, and all parameters are fitted again. If the model is linear, the sum of squares
/// rises there by 3.84 variances of white noise. If it does not, within the factor levels::rise,
/// the interval of the profile stands in its place: up to where the sum of squares has risen so far
/// (Venzon and Moolgavkar 1988, Appl. Stat. 37, 87), or without an end if it has not within ten
/// times the linear interval. Only numbers are visited whose interval is in
/// doubt, since a few rows bend by more than levels::bent over it.
std::vector<Interval> intervals_not_visited(const Fitted&, const Uncertainty& noise,
                                            const FitOptions&);

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
