// SPDX-License-Identifier: GPL-3.0-or-later
// The line of fitpower above its rows, apart from reading it (cli/fit_line.h): it needs the table
// of laws, and with it GSL, which most tools do without.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/input.h"

namespace rolling {

/// The line of fitpower above its rows: `fitpower VERSION ROUTE [LAW] K 0.5+-0.005 R 0.04 g 9.81
/// slope 0 [wind 0] [exact]`, with a list where the runs differ, and `slope fit` where the slope is
/// in the rows. Without the numbers if those of a run are not known.
std::string line_of_fit(const std::string& route, const FitOptions&,
                        const std::vector<std::optional<ShiftOf>>& of_runs);

}  // namespace rolling
