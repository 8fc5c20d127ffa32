#include "noise/response.h"

#include "base/error.h"

#include <algorithm>

namespace rolling {

namespace {

/// The columns of each row, in a filter with this reach, that may be different from 0.
struct Band {
  std::size_t n, reach;

  std::size_t most() const { return std::min(2 * reach, n); }  // reach of a row at an end
  bool inside(std::size_t i) const { return i >= reach && i + reach < n; }
  std::size_t first(std::size_t i) const {
    const std::size_t side = inside(i) ? reach : most();
    return i > side ? i - side : 0;
  }
  std::size_t end(std::size_t i) const { return std::min(n, i + (inside(i) ? reach : most()) + 1); }
};

/// The matrix of a shift-invariant filter, constructed from its matrix on a short run.
BandMatrix repeated(LinearFilter filter, std::span<const double> t) {
  const std::size_t n = t.size(), end = 2 * filter.reach + 1;
  filter.shift_invariant = false;
  const BandMatrix few = probe(filter, t.first(3 * end));
  BandMatrix L;
  L.reserve(n, 0);
  for (std::size_t i = 0; i < end; ++i) L.append(few.first(i), few.row(i));
  for (std::size_t i = end; i + end < n; ++i) L.append(few.first(end) + i - end, few.row(end));
  for (std::size_t i = 2 * end; i < 3 * end; ++i) L.append(few.first(i) + n - 3 * end, few.row(i));
  return L;
}

}  // namespace

BandMatrix probe(const LinearFilter& filter, std::span<const double> t) {
  // A row reaches at most 2 * reach to either side (that far only at the ends of the run), so that
  // it responds to only one of several impulses at a distance of 4 * reach + 1.
  const Band rows{t.size(), filter.reach};
  const std::size_t n = t.size(), spacing = std::min(4 * filter.reach + 1, n);
  if (filter.shift_invariant && n > 3 * (2 * filter.reach + 1)) return repeated(filter, t);
  std::vector<std::size_t> start{0};
  start.reserve(n + 1);
  for (std::size_t i = 0; i < n; ++i) start.push_back(start.back() + rows.end(i) - rows.first(i));
  std::vector<double> all(start.back()), comb(n);
  for (std::size_t k = 0; k < spacing; ++k) {
    for (std::size_t j = k; j < n; j += spacing) comb[j] = 1;
    const auto response = filter.apply(t, comb);
    if (response.size() != n)
      fail("a filter of {} gives {} values for {} records", filter.from, response.size(), n);
    for (std::size_t j = k; j < n; j += spacing) {
      comb[j] = 0;
      const std::size_t end = std::min(n, j + rows.most() + 1);
      for (std::size_t i = j > rows.most() ? j - rows.most() : 0; i < end; ++i)
        if (rows.first(i) <= j && j < rows.end(i)) all[start[i] + j - rows.first(i)] = response[i];
    }
  }
  BandMatrix L;
  L.reserve(n, all.size());
  for (std::size_t i = 0; i < n; ++i)
    L.append(rows.first(i), std::span(all).subspan(start[i], start[i + 1] - start[i]));
  return L;
}

Response response_of(const FilterChain& chain, std::span<const double> t) {
  Response response;
  if (chain.empty()) return response;
  response.source = chain.front().from;
  response.of.emplace(response.source, FilterMatrix::identity(t.size()));
  for (const auto& filter : chain) {
    const auto input = response.of.find(filter.from);
    if (input == response.of.end())
      fail("the filters start from two columns, {} and {}: their noises are not known together",
           response.source, filter.from);
    BandMatrix L = probe(filter, t);
    response.of.insert_or_assign(
        filter.to, L.is_identity() ? input->second : input->second.then(std::move(L)));
  }
  return response;
}

}  // namespace rolling
