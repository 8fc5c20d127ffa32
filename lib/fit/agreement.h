// SPDX-License-Identifier: GPL-3.0-or-later
// Do the runs of a joint fit agree, and what are its errors worth where they do not?
#pragma once

#include "fit/errors.h"

namespace rolling {

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
std::optional<Agreement> agreement_of(Route, const std::vector<FitRun>&, const FitOptions&,
                                      NoiseErrors& errors, Fitted& joint);

/// The joint fit of runs that are known to disagree, with the values that agreement_of() gives it.
Fitted fit_of_disagreeing(Route, const std::vector<FitRun>&, const FitOptions&);

}  // namespace rolling
