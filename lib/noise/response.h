// SPDX-License-Identifier: GPL-3.0-or-later
// The columns of a run as linear functions of the one raw column that the sensor recorded.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "base/quantity.h"
#include "noise/band_matrix.h"

namespace rolling {

/// One linear filter of a chain: column `to` = L times column `from`. Row i of L is zero further
/// than `reach` samples from i (further than 2 * reach at the ends of a run, where a row may be
/// one-sided).
struct LinearFilter {
  Quantity from, to;
  std::size_t reach;
  std::function<std::vector<double>(std::span<const double> t, std::span<const double> y)> apply;
  /// L[i][j] depends on i - j alone, except in the 2 reach + 1 rows at either end.
  bool shift_invariant = false;
};

/// The filters in the order in which they were applied; the first one reads the raw column.
using FilterChain = std::vector<LinearFilter>;

/// The matrix of a filter for rows at the times t, measured as its response to combs of unit
/// impulses. Throws Error if the filter does not return one value for each row.
BandMatrix probe(const LinearFilter&, std::span<const double> t);

/// The response of a chain of filters to its raw column.
struct Response {
  Quantity source;  ///< the raw column, whose noise is assumed white
  /// The matrix of each column, the raw one included: one row for each reading of the run.
  PerQuantity<Filters> of;
};

/// The response of a chain on the times t of a run. Throws Error for a chain that starts from more
/// than one raw column.
Response response_of(const FilterChain&, std::span<const double> t);

}  // namespace rolling
