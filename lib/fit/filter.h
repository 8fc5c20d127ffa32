// What was done to the numbers of a run before they came to be fitted: linear filters, known only
// by what they do.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace rolling {

/// One linear filter of a chain: output column = L input column. Row i of L reaches at most `reach`
/// samples to either side of i (at the ends of a run a one-sided row may reach 2 * reach).
struct LinearFilter {
  std::string from, to;  ///< columns, by their short names
  std::size_t reach;
  std::function<std::vector<double>(std::span<const double> t, std::span<const double> y)> apply;
  bool shift_invariant = false;  ///< but for the 2 reach + 1 rows at either end, L[i][j] depends on
                                 ///< i - j alone
  bool cut_begin = false,
       cut_end = false;  ///< then records were cut away there before this filter came
};

/// In order; it starts with the filter of the raw column.
using FilterChain = std::vector<LinearFilter>;

}  // namespace rolling
