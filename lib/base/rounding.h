// SPDX-License-Identifier: GPL-3.0-or-later
// The rounding error of the program that computed a column.
#pragma once

namespace rolling {

/// Readings that differ by less than this share of the largest reading of the run differ by the
/// rounding error of the program that computed them, and not by a digit that it wrote.
inline constexpr double program_rounding = 1e-9;

}  // namespace rolling
