// SPDX-License-Identifier: GPL-3.0-or-later
// The `##` line of fitpower: of what its rows were made.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contact/law.h"
#include "fit/input.h"

namespace rolling {

/// The line of fitpower above its rows: `fitpower VERSION ROUTE [LAW] K 0.5+-0.005 R 0.04 g 9.81
/// slope 0 [wind 0] [exact]`, with a list where the runs differ, and `slope fit` where the slope is
/// in the rows. Without the numbers if those of a run are not known.
std::string line_of_fit(const std::string& route, const FitOptions&,
                        const std::vector<std::optional<ShiftOf>>& of_runs);

/// The body, the slope and the geometry of which each of `rows` rows was made, by the line of
/// fitpower above them; NaN for a slope and a wind that are in the rows. None if there is no such
/// line, if it has no numbers, or if its numbers are those of more runs than rows. Throws Error for
/// a line that fitpower does not write.
std::vector<ShiftOf> contacts_of_rows(const std::vector<std::string>& lines, std::size_t rows);

}  // namespace rolling
