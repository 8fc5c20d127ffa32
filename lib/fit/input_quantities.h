// SPDX-License-Identifier: GPL-3.0-or-later
// The errors that come from numbers which are given: K, R, g and the slope of the mat.
#pragma once

#include "fit/fitted.h"
#include "fit/result.h"

namespace rolling {

/// The contribution of each given number with an uncertainty. Runs with the same value and
/// uncertainty have the same body; they change together. The derivative is a central difference of
/// two fits, with the number one standard uncertainty (or a tenth of the number, if that is less)
/// above and below its value. On the routes that read D, which was computed with these numbers, D
/// is computed again from the same accelerations. Where the runs do not agree, their law is that of
/// their means (see agreement_of()) for the changed number too. If a alone depends on the number,
/// in proportion to (K + 1) R/g, nothing is fitted again. Throws Error if the fit itself is not
/// possible.
std::vector<ErrorShare> shares_of_given(Route, const std::vector<FitRun>&, const FitOptions&,
                                        const Fitted&, bool agree);

}  // namespace rolling
