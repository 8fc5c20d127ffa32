// SPDX-License-Identifier: GPL-3.0-or-later
// The median, by partial sorting.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
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
    const std::size_t first = i < 2 ? 0 : i - 2;
    const std::size_t end = std::min(i + 3, values.size());
    std::vector<double> near(&values[first], &values[first] + (end - first));
    medians.push_back(median(near));
  }
  return medians;
}

/// The size that this share of the numbers does not reach. Missing ones, which are not finite, do
/// not count; 0 if there are no others. O(n).
inline double size_at(double share, std::vector<double> numbers) {
  std::erase_if(numbers, [](double x) { return !std::isfinite(x); });
  if (numbers.empty()) return 0;
  for (double& x : numbers) x = std::abs(x);
  return nth_smallest(numbers,
                      static_cast<std::size_t>(share * static_cast<double>(numbers.size())));
}
inline double typical_size(std::vector<double> numbers) { return size_at(0.5, std::move(numbers)); }

/// The standard deviation of normal numbers around 0, with outliers. Steps of rounded readings, of
/// which most are 0, do not make it 0 as early as they do the median.
inline double deviation(std::vector<double> numbers) { return size_at(0.6827, std::move(numbers)); }

}  // namespace rolling
