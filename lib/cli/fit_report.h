// SPDX-License-Identifier: GPL-3.0-or-later
// The messages of fitpower in addition to its row: warnings, the report, and the check of the fit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/tool.h"
#include "fit/diagnostics.h"
#include "fit/fit.h"

namespace rolling {

/// Runs that are fitted together, and their fit.
struct FitOfRuns {
  Route route;
  std::vector<FitRun> runs;
  std::optional<FitResult> result = {};    ///< none where they cannot be fitted
  std::optional<LawComparison> laws = {};  ///< where laws are compared
};

/// "the runs disagree ...: run 3 stands out, its D(0.21 m/s) by -4.1 +- 0.4 %, its b by +0.012 +-
/// 0.004; ...".
std::string disagreement(const Agreement&, const std::vector<FitRun>&);

/// Warns of what spoils a fit: a shift beyond the radius, runs that disagree, readings that are off
/// or repeat, a b far below what mats have. Where there is none of it, and no law is better, also
/// of what such a cause would bring with it: noise that is not white, an eccentric body, an a whose
/// error is not that of a normal distribution. A check fails by runs that disagree, a reading that
/// is off and such a b; by standard errors that do not exist (unless a and b are both fixed),
/// another law that is better by 10 in AICc, the beginning of a run that is disturbed, and
/// residuals that are not white.
void remark(Tool&, const FitOfRuns&, const FitOptions&);

/// Reports how the uncertainties were made, and of which parts; the coefficients of all laws, and
/// whether another is better than this.
void report(Tool&, const FitOfRuns&, const LawForm&);

}  // namespace rolling
