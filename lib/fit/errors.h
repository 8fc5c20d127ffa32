// SPDX-License-Identifier: GPL-3.0-or-later
// The standard errors of a fit: from the noise of its rows, from runs that disagree, and from the
// input quantities, which are the K, R, g and slope that are given.
#pragma once

#include "fit/fit.h"
#include "fit/fitted.h"

namespace rolling {

/// What the noise of a fit does to its numbers.
struct Uncertainty {
  Errors kind;
  double whiteness;   ///< as in FitResult
  Matrix covariance;  ///< of Fitted::numbers(); 0 for one that is fixed
};

/// Q = J R^-1 at the minimum. The meat M of the covariance R^-1 M R^-T is a quadratic form of the
/// rows of Q.
Matrix orthonormal(const System&, const Minimum&);

/// The noise that the residuals of a fit with this Q show; of a log-log line behind known filters,
/// that of the roll that made its rows.
SeenNoise seen_noise(const Fitted&, Matrix Q);

/// The covariance of a fit, R^-1 M R^-T with the meat M of the sandwich. For known filters it is
/// exact, otherwise the classical s^2 (J^T J)^-1. With 30 or more rows the noise is tested (for
/// known filters the noise of the raw column). If it is not white (Ljung and Box), the covariance
/// is that of Newey and West, already at 10 % if neighbouring residuals are positively correlated;
/// otherwise, if the variance is uneven at 1 %, along the runs or between them, it is HC3.
Uncertainty uncertainty_of(const Fitted&, Matrix Q);
inline Uncertainty uncertainty_of(const Fitted& fit) {
  return uncertainty_of(fit, orthonormal(fit.system(), fit.minimum));
}

/// The mean variance that the rounding of the readings leaves them; 0 behind filters. Gates fix x
/// or v, and t is measured: readings on a grid that are far closer to the roll than rounding would
/// leave them, of which none repeats and whose times are not those of a clock, are not rounded.
double variance_of_rounding(const Fitted&);

/// The correlations of the first n numbers; 0 where a variance is 0, as that of a number that is
/// fixed.
Matrix correlations_of(const Matrix& covariance, std::size_t n);

/// Compares the runs of a joint fit. Each run is fitted by itself, with a and b of its own (the
/// slope of the mat is fixed at that of the joint fit); its law (ln a, b) is compared with the mean
/// of all, weighted by the inverse covariances of the runs' own errors. Its p is that of
/// the law with which all agree best. Returns nothing where fewer than two runs determine a law by
/// themselves, or where a and b are fixed.
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

/// The contribution of each given number with an uncertainty. Runs with the same value and
/// uncertainty have the same body; they change together. The derivative is a central difference of
/// two fits, with the number one standard uncertainty (or a tenth of the number, if that is less)
/// above and below its value. On the routes that read D, which was computed with these numbers, D
/// is computed again from the same accelerations. Where the runs do not agree, their law is that of
/// their means (see agreement_of()) for the changed number too. If a alone depends on the number,
/// in proportion to (K + 1) R/g, nothing is fitted again. Throws Error if the fit itself is not
/// possible.
std::vector<ErrorShare> shares_of_given(Route, const std::vector<Run>&, const FitOptions&,
                                        const Fitted&, bool agree);

}  // namespace rolling
