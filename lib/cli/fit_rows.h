// SPDX-License-Identifier: GPL-3.0-or-later
// The route fits of fitpower: the joint law of its own rows.
#pragma once

#include "cli/fit_runs.h"

namespace rolling {

/// Reads rows of fitpower and prints their joint law (fit/run_laws.h). What the
/// uncertainties of K, R and g have brought to each row is common to the rows that give the same
/// number with the same uncertainty.
void fit_rows(Tool&, const Bodies&);

}  // namespace rolling
