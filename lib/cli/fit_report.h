// What fitpower says beside its row: warnings, the report, and whether the fit passes its check.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "cli/tool.h"
#include "fit/beginning.h"
#include "fit/laws.h"

namespace rolling {

/// The routes by the names of the command line; none where the columns decide.
std::map<std::string, std::optional<Route>> fit_routes();

/// The columns that a route fits, by their short names.
std::vector<std::string> columns_of(Route);

/// What the user should know: errors that are not those of white noise, runs that disagree (which
/// check() tells, if it comes), logarithms of noise, a body that does not run true. The names are
/// those of the runs of the fit.
void warn_of(Tool&, Route, const FitResult&, std::span<const std::string> names, bool check_comes);

/// The laws on the records of one fit; none for a robust fit, which is no matter of squares.
std::optional<LawComparison> compare_if_possible(Route, const std::vector<FitRun>&,
                                                 const FitOptions&);

/// A beginning that does not go on as the rest of its run; none for a robust fit.
std::optional<Beginning> beginning_if_possible(Route, const std::vector<FitRun>&,
                                               const FitOptions&);

/// What each route finds at which cost, the coefficients of the laws, and which is the best.
void report(Tool&, const std::vector<FitRun>&, const FitOptions&,
            const std::optional<LawComparison>&);

/// Fails the check of the tool where the runs of a joint fit disagree, another law is better by 10
/// in AICc, the beginning of a run does not go on as its rest, or the residuals are not white.
void check(Tool&, const FitResult&, const std::optional<LawComparison>&,
           const std::optional<Beginning>&, std::span<const std::string> names);

}  // namespace rolling
