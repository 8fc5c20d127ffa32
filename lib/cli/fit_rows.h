// SPDX-License-Identifier: GPL-3.0-or-later
// The route fits of fitpower: the joint law of its own rows.
#pragma once

#include "cli/tool.h"

namespace rolling {

/// Reads rows of fitpower and prints their joint law (fit/joint_law.h). What the
/// uncertainties of K, R and g have brought to each row is common to the rows that give the same
/// number with the same uncertainty; there is one K and one R, or one for each row, or none.
int fit_rows(Tool&, const Body&, const std::vector<Estimate>& shape_factors,
             const std::vector<Estimate>& radii, const BodyUncertainty&, bool with_check);

}  // namespace rolling
