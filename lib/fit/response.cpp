#include "fit/response.h"

#include "base/error.h"

#include <algorithm>

namespace rolling {

BandMatrix probe(const LinearFilter& filter, std::span<const double> t) {
  // A row reaches at most 2 reach to either side (that far only at the ends), so of impulses 4
  // reach + 1 apart it sees one.
  const std::size_t n = t.size(), most = std::min(2 * filter.reach, n),
                    spacing = std::min(4 * filter.reach + 1, n);
  const auto span_of = [&](std::size_t i) {
    const bool end = i < filter.reach || i + filter.reach >= n;
    const std::size_t to_side = end ? most : filter.reach, first = i > to_side ? i - to_side : 0;
    return std::pair(first, std::min(n, i + to_side + 1));
  };
  std::vector<std::size_t> start{0};
  for (std::size_t i = 0; i < n; ++i)
    start.push_back(start.back() + span_of(i).second - span_of(i).first);
  std::vector<double> all(start.back()), comb(n);
  for (std::size_t k = 0; k < spacing; ++k) {
    for (std::size_t j = 0; j < n; ++j) comb[j] = j % spacing == k;
    const auto response = filter.apply(t, comb);
    if (response.size() != n)
      fail("a filter of {} gives {} values for {} records", filter.from, response.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
      const auto [first, end] = span_of(i);
      const std::size_t j = first + (k + spacing - first % spacing) %
                                        spacing;  // the first impulse at or after `first`
      if (j < end) all[start[i] + j - first] = response[i];
    }
  }
  BandMatrix L;
  L.reserve(n, all.size());
  for (std::size_t i = 0; i < n; ++i)
    L.append(span_of(i).first, std::span(all).subspan(start[i], start[i + 1] - start[i]));
  return L;
}

Response response_of(const FilterChain& chain, std::span<const double> t) {
  Response response;
  if (chain.empty()) return response;
  std::size_t reach = 0, before = 0,
              after = 0;  // how far beyond the run the filters ahead of the last cut reach
  for (const auto& filter : chain) {
    if (filter.cut_begin) before = reach;
    if (filter.cut_end) after = reach;
    reach += filter.reach;
  }
  const std::size_t n = t.size();
  for (std::size_t k = before; k > 0 && n > 1; --k)
    response.t.push_back(t[0] - static_cast<double>(k) * (t[1] - t[0]));
  response.t.insert(response.t.end(), t.begin(), t.end());
  for (std::size_t k = 1; k <= after && n > 1; ++k)
    response.t.push_back(t[n - 1] + static_cast<double>(k) * (t[n - 1] - t[n - 2]));

  std::span<const double> present = response.t;
  std::size_t still_before = before, still_after = after;
  reach = 0;
  response.source = chain.front().from;
  response.of.emplace(response.source,
                      std::make_shared<const BandMatrix>(BandMatrix::identity(present.size())));
  for (const auto& filter : chain) {
    const auto input = response.of.find(filter.from);
    if (input == response.of.end())
      fail("the filters start from two columns, {} and {}: their noises are not known together",
           response.source, filter.from);
    const std::size_t first = filter.cut_begin && n > 1 ? still_before - (before - reach) : 0,
                      last = filter.cut_end && n > 1 ? still_after - (after - reach) : 0;
    if (first + last > 0) {
      for (auto& [name, matrix] : response.of)
        matrix = std::make_shared<const BandMatrix>(matrix->without(first, last));
      present = present.subspan(first, present.size() - first - last);
      still_before -= first;
      still_after -= last;
    }
    BandMatrix L = probe(filter, present);
    response.of.insert_or_assign(
        filter.to,
        L.is_identity() ? input->second : std::make_shared<const BandMatrix>(L * *input->second));
    reach += filter.reach;
  }
  return response;
}

}  // namespace rolling
