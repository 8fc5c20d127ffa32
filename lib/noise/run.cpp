// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/median.h"
#include "base/grid.h"
#include "contact/contact.h"

namespace rolling {
namespace {

/// A column that is computed again, and how many rows on either side it has read.
struct Recomputed {
  std::vector<double> values;  ///< empty if it is not known
  std::size_t reach = 0;
};

/// The column of a run that its filters may have made; empty if it is not known.
std::vector<double> column_of_run(const Run& run, Quantity q) {
  if (q == Quantity::t || (q == Quantity::D && !run.shift_of)) return {};
  return run[q];
}

/// The output of a filter. What may have read a missing reading is missing, too.
Recomputed applied(const LinearFilter& filter, std::span<const double> t, Recomputed input) {
  std::vector<double>& y = input.values;
  const std::size_t n = t.size();
  const std::size_t reach = 2 * filter.reach;
  if (y.size() != n || n == 0) return {};
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < n; ++i)
    if (!std::isfinite(y[i])) {
      missing.push_back(i);
      y[i] = 0;
    }
  Recomputed output{filter.apply(t, y), input.reach + filter.reach};
  for (const std::size_t i : missing)
    for (std::size_t k = i - std::min(i, reach); k < std::min(i + reach + 1, n); ++k)
      output.values[k] = NAN;
  return output;
}

/// The noise of y from row to row: the median size of the third divided differences, which a
/// quadratic function of time does not have, in units of those of white noise of variance one.
double roughness(std::span<const double> t, std::span<const double> y) {
  std::vector<double> all;
  for (std::size_t first = 0; first + 4 <= t.size(); ++first) {
    double sum = 0;
    double squares = 0;
    for (std::size_t i = first; i < first + 4; ++i) {
      double weight = 1;
      for (std::size_t k = first; k < first + 4; ++k)
        if (k != i) weight /= t[i] - t[k];
      sum += weight * y[i];
      squares += weight * weight;
    }
    all.push_back(sum / std::sqrt(squares));
  }
  return typical_size(std::move(all));
}

/// The last decimal place of a number that is not 0, down to `least`.
double last_place(double y, double least) {
  double place = 1;
  while (place < std::abs(y)) place *= 10;
  while (place > least && std::abs(y - std::round(y / place) * place) > least) place /= 10;
  return place;
}

/// Compares a column that was computed again with that of the run, both at the times t.
void compare(std::span<const double> t, const Recomputed& computed,
             const std::vector<double>& given, Mismatch& result) {
  const std::size_t n = given.size();
  const std::size_t reach = computed.reach;
  if (n < 2 * reach + 3) return;
  std::vector<double> off(n);
  double along = 0;
  double computed2 = 0;
  double off2 = 0;  // sums of products inside the run
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double y = computed.values[i];
    const double difference = y - given[i];
    off[i] = std::abs(difference);
    if (!std::isfinite(difference)) continue;
    largest = std::max(largest, std::abs(given[i]));
    if (i >= reach && i + reach < n) {
      along += y * difference;
      computed2 += y * y;
      off2 += difference * difference;
    }
  }
  const double large = typical_size(given);
  const double typical = typical_size(off);
  const double unseen = roughness(t, computed.values) / 2;
  const double least = program_rounding * largest;
  const auto beyond_rounding = [&](std::size_t i) {
    return off[i] > unseen && (given[i] == 0 || off[i] > least + last_place(given[i], least) / 2);
  };
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < n; ++i) beyond += beyond_rounding(i);
  result.inside |= typical > 1e-5 * large && 2 * beyond > n;
  // Differences that are proportional to the column are a factor, not rounding.
  result.inside |= std::abs(along) > 1e-6 * computed2 && along * along > 0.99 * computed2 * off2;
  const double most = std::max(20 * typical, 1e-6 * large);
  for (std::size_t i = 0; i < n; ++i) {
    const bool differs =
        off[i] > most && (off[i] > 0.01 * std::abs(given[i]) || beyond_rounding(i));
    if (!differs) continue;
    if (i < reach) result.begin = true;
    else if (i + reach >= n) result.end = true;
    else result.inside = true;
  }
}

}  // namespace

Mismatch mismatch(const FilterChain& filters, const Run& run) {
  Mismatch result;
  PerQuantity<Recomputed> columns;
  for (std::size_t k = 0; k < filters.size(); ++k) {
    const LinearFilter& filter = filters[k];
    const auto changed_from = [&](std::size_t first, Quantity q) {
      return std::any_of(filters.begin() + static_cast<std::ptrdiff_t>(first), filters.end(),
                         [&](const LinearFilter& later) { return later.to == q; });
    };
    Recomputed input = columns[filter.from];
    if (!changed_from(k, filter.from))
      if (auto of_run = column_of_run(run, filter.from); !of_run.empty()) {
        if (filter.from == Quantity::D)
          for (double& y : of_run) y = acceleration_of(*run.shift_of, y);
        input = {std::move(of_run)};
      }
    const Recomputed& output = columns[filter.to] = applied(filter, run.t, std::move(input));
    const std::vector<double> given = column_of_run(run, filter.to);
    if (output.reach == 0 || output.values.empty() || given.empty() ||
        changed_from(k + 1, filter.to))
      continue;
    Recomputed computed = output;
    if (filter.to == Quantity::D)  // the filters speak of the acceleration
      for (double& y : computed.values) y = shift_from_acceleration(*run.shift_of, y);
    compare(run.t, computed, given, result);
  }
  return result;
}

}  // namespace rolling
