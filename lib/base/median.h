// The median, by partial sorting.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>

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

}  // namespace rolling
