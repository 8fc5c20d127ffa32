// SPDX-License-Identifier: GPL-3.0-or-later
// The messages of fitpower in addition to its row: warnings, the report, and the check of the fit.
#pragma once

#include <optional>
#include <string>

#include "cli/tool.h"
#include "fit/diagnostics.h"
#include "fit/laws.h"
#include "fit/fit.h"

namespace rolling {

/// "the runs disagree ...: run 3 stands out, its D(0.21 m/s) is 4.1 +- 0.4 % less than that of the
/// others, its b 0.012 +- 0.004 more; this test takes K as exact; ...". `given` names the numbers
/// that have uncertainties.
std::string disagreement(const Agreement&, const std::vector<FitRun>&, const std::string& given);

/// Why a route leaves rows out.
std::string why_left_out(Route, const FitOptions&);

/// Warns of what spoils a fit: a shift beyond the radius, runs that disagree, readings that are off
/// or repeat, a b far below what mats have. Where there is none of it, and no law is better, also
/// of what such a cause would bring with it: noise that is not white, an eccentric body, an a whose
/// error is not that of a normal distribution. With a check, runs that disagree, a reading that is
/// off and such a b make it fail; so do standard errors that do not exist (unless a and b are both
/// fixed), another law that is better by 10 in AICc, the beginning of a run that is disturbed, and
/// residuals that are not white.
void remark(Tool&, Route, const FitResult&, const std::vector<FitRun>&, const FitOptions&,
            const std::optional<LawComparison>&, bool with_check);

/// Reports the result and the computing time of each route, the coefficients of the laws, and
/// whether another law is better.
void report(Tool&, const std::vector<FitRun>&, const FitOptions&,
            const std::optional<LawComparison>&);

}  // namespace rolling
