// SPDX-License-Identifier: GPL-3.0-or-later
// A matrix with many rows and few columns, such as J.
#pragma once

#include <vector>

namespace rolling {

/// The columns of a matrix, each in memory of its own.
using Matrix = std::vector<std::vector<double>>;

}  // namespace rolling
