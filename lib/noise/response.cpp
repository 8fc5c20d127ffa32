// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/response.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace rolling {

namespace {

/// A filter depends on differences of times alone: where all steps are equal, or do not matter, it
/// has the same row at all times but near the ends, and a short run shows all of its rows. Steps of
/// time that differ by less than this share are equal, since times are rounded. (At 500 kHz and
/// times of a few seconds the rounding is 2e-10 of a step.)
bool same_everywhere(const LinearFilter& filter, std::span<const double> t) {
  constexpr double rounding = 1e-9;
  for (std::size_t i = 2; i < t.size() && !filter.shift_invariant; ++i)
    if (std::abs((t[i] - t[i - 1]) - (t[1] - t[0])) > rounding * (t[1] - t[0])) return false;
  return true;
}

}  // namespace

BandMatrix probe(const LinearFilter& filter, std::span<const double> times) {
  const std::size_t side = 2 * filter.reach + 1;
  const std::size_t n =
      same_everywhere(filter, times) ? std::min(times.size(), 3 * side) : times.size();
  std::vector<double> t(times.begin(), times.end());
  for (double& time : t) time -= times.front();
  if (n < times.size()) {
    // The rounding of two times would be an error of all rows. Of the mean step, with six bits
    // less, small multiples are exact: the weights of a derivative sum to 0.
    double step = t.back() / static_cast<double>(t.size() - 1);
    step = (step + 64 * step) - 64 * step;
    t.resize(n);
    for (std::size_t i = 0; i < n; ++i) t[i] = static_cast<double>(i) * step;
  }
  // A row inside the run reads 2 * reach + 1 columns, and one of the `reach` rows at either end at
  // most 3 * reach: it responds to only one of several impulses at this distance.
  const std::size_t spacing = std::min(std::max(side, 3 * filter.reach), n);
  std::vector<double> all(n * spacing);
  std::vector<double> comb(n);
  std::vector<double> row;
  for (std::size_t k = 0; k < spacing; ++k) {
    for (std::size_t j = k; j < n; j += spacing) comb[j] = 1;
    const auto response = filter.apply(t, comb);
    if (response.size() != n)
      fail("a filter of {} gives {} values for {} rows", name_of(filter.from), response.size(), n);
    for (std::size_t j = k; j < n; j += spacing) comb[j] = 0;
    for (std::size_t i = 0; i < n; ++i) all[i * spacing + k] = response[i];
  }
  BandMatrix L(times.size());  // what a row reads lies within `spacing` columns around it
  for (std::size_t i = 0; i < times.size(); ++i) {
    const std::size_t k = std::max(std::min(i, side), i + n - std::min(i + n, times.size()));
    const std::size_t first = std::min(k - std::min(k, spacing / 2), n - spacing);
    row.clear();
    for (std::size_t j = first; j < first + spacing; ++j)
      row.push_back(all[k * spacing + j % spacing]);
    L.append(first + i - k, row);
  }
  return L;
}

Response response_of(const FilterChain& chain, std::span<const double> t) {
  Response response{.source = chain.front().from, .of = {}};
  response.of[response.source] = std::make_shared<const BandMatrix>(BandMatrix::identity(t.size()));
  for (const auto& filter : chain) {
    const Filters& input = response.of[filter.from];
    if (!input)
      fail("the filters start from two columns, {} and {}: their noises are not known together",
           name_of(response.source), name_of(filter.from));
    response.of[filter.to] = std::make_shared<const BandMatrix>(probe(filter, t) * *input);
  }
  return response;
}

}  // namespace rolling
