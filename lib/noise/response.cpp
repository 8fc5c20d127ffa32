// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/response.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace rolling {

namespace {

/// A run whose rows stand for all rows of a longer one: row i of that has the elements of row
/// `row[i]` of this, as many columns further on as i is beyond row[i].
struct Short {
  std::vector<double> t;
  std::vector<std::size_t> row;
};

/// Steps of time that differ by less than this share are equal: times are rounded. (At 500 kHz and
/// times of a few seconds the rounding is 2e-10 of a step.)
constexpr double rounding = 1e-9;

/// Leaves out the inner rows of each long stretch of equal steps. A filter depends on
/// differences of times alone, so that these readings have the same row. The steps of the stretch
/// become its mean step: the rounding of two times would be an error of all of these rows.
Short shortened(const LinearFilter& filter, std::span<const double> t) {
  const std::size_t n = t.size(), end = 2 * filter.reach + 1, most = 3 * end;
  Short few;
  few.row.reserve(n);
  double origin = t[0];
  for (std::size_t first = 0, last; first + 1 < n; first = last) {
    const double step = t[first + 1] - t[first];
    const auto even = [&](std::size_t i) {
      return filter.shift_invariant || std::abs(t[i] - t[i - 1] - step) <= rounding * step;
    };
    for (last = first + 1; last + 1 < n && even(last + 1);) ++last;
    const std::size_t before = few.t.size(), count = last + 1 - first;
    if (count <= most) {
      for (std::size_t i = first; i < last; ++i) {
        few.row.push_back(few.t.size());
        few.t.push_back(t[i] - origin);
      }
      continue;
    }
    const double begin = t[first] - origin;
    double mean = (t[last] - t[first]) / static_cast<double>(last - first);
    // Six bits less: small multiples of the step are exact, and the weights of a derivative sum to
    // 0.
    mean = (mean + 64 * mean) - 64 * mean;
    for (std::size_t k = 0; k + 1 < most; ++k)
      few.t.push_back(begin + static_cast<double>(k) * mean);
    for (std::size_t k = 0; k + 1 < count; ++k)
      few.row.push_back(before + (k < 2 * end ? k : k + end < count ? end : k + most - count));
    origin = t[last] - (begin + static_cast<double>(most - 1) * mean);
  }
  few.row.push_back(few.t.size());
  few.t.push_back(t[n - 1] - origin);
  return few;
}

}  // namespace

BandMatrix probe(const LinearFilter& filter, std::span<const double> times) {
  const Short few = shortened(filter, times);
  // A row inside the run reads 2 * reach + 1 columns, and one of the `reach` rows at either end at
  // most 3 * reach: it responds to only one of several impulses at this distance.
  const std::size_t n = few.t.size(), reach = filter.reach,
                    spacing = std::min(std::max(2 * reach + 1, 3 * reach), n);
  std::vector<double> all(n * spacing), comb(n), row;
  for (std::size_t k = 0; k < spacing; ++k) {
    for (std::size_t j = k; j < n; j += spacing) comb[j] = 1;
    const auto response = filter.apply(few.t, comb);
    if (response.size() != n)
      fail("a filter of {} gives {} values for {} rows", filter.from, response.size(), n);
    for (std::size_t j = k; j < n; j += spacing) comb[j] = 0;
    for (std::size_t i = 0; i < n; ++i) all[i * spacing + k] = response[i];
  }
  BandMatrix L(times.size());  // what a row reads lies within `spacing` columns around it
  for (std::size_t i = 0; i < times.size(); ++i) {
    const std::size_t k = few.row[i], first = std::min(k - std::min(k, spacing / 2), n - spacing);
    if (i == 0 || k != few.row[i - 1]) {
      row.clear();
      for (std::size_t j = first; j < first + spacing; ++j)
        row.push_back(all[k * spacing + j % spacing]);
    }
    L.append(first + i - k, row);
  }
  return L;
}

Response response_of(const FilterChain& chain, std::span<const double> t) {
  Response response;
  response.source = chain.front().from;
  response.of[response.source] = std::make_shared<const BandMatrix>(BandMatrix::identity(t.size()));
  for (const auto& filter : chain) {
    const auto input = response.of.find(filter.from);
    if (input == response.of.end())
      fail("the filters start from two columns, {} and {}: their noises are not known together",
           response.source, filter.from);
    response.of[filter.to] = std::make_shared<const BandMatrix>(probe(filter, t) * *input->second);
  }
  return response;
}

}  // namespace rolling
