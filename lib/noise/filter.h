// SPDX-License-Identifier: GPL-3.0-or-later
// Linear filters that were applied to the columns of a run before the fit. A filter is known by its
// output alone.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace rolling {

/// One linear filter of a chain: column `to` = L times column `from`. Row i of L is zero further
/// than `reach` samples from i (further than 2 * reach at the ends of a run, where a row may be
/// one-sided).
struct LinearFilter {
  std::string from, to;  ///< short names of the columns
  std::size_t reach;
  std::function<std::vector<double>(std::span<const double> t, std::span<const double> y)> apply;
  /// L[i][j] depends on i - j alone, except in the 2 reach + 1 rows at either end.
  bool shift_invariant = false;
};

/// The filters in the order in which they were applied; the first one reads the raw column.
using FilterChain = std::vector<LinearFilter>;

}  // namespace rolling
