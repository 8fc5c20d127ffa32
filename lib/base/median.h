// SPDX-License-Identifier: GPL-3.0-or-later
// The median, by partial sorting.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace rolling {

/// The number of this rank (0 is the smallest). Changes the order of the values. O(n).
inline double nth_smallest(std::span<double> values, std::size_t rank) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The median of at least one value; of an even number of values, the mean of the middle two.
/// Changes the order of the values. O(n).
inline double median(std::span<double> values) {
  const std::size_t half = values.size() / 2;
  const double upper = nth_smallest(values, half);
  if (values.size() % 2 == 1) return upper;
  return std::midpoint(*std::max_element(values.begin(), values.begin() + std::ptrdiff_t(half)),
                       upper);
}

/// The median of each value and the two on either side, as far as there are some.
inline std::vector<double> medians_of_five(const std::vector<double>& values) {
  std::vector<double> medians;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t first = i < 2 ? 0 : i - 2, end = std::min(i + 3, values.size());
    std::vector<double> near(&values[first], &values[first] + (end - first));
    medians.push_back(median(near));
  }
  return medians;
}

/// The standard deviation of normal numbers with outliers, from how far they are from their mean:
/// 68.27 % of the distances are less. Steps of rounded readings, of which most are 0, do not make
/// it 0 as early as they do the median. There is at least one. Changes the order of them. O(n).
inline double deviation(std::span<double> distances) {
  const auto count = static_cast<double>(distances.size());
  return nth_smallest(distances, static_cast<std::size_t>(0.6827 * count));
}

}  // namespace rolling
