#include "noise/response.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

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

/// Steps of time that differ by less than this share are equal: times are rounded. (At 500 kHz and
/// times of a few seconds the rounding is 2e-10 of a step.)
constexpr double rounding = 1e-9;

/// True for each record whose row is that of the record before it, moved by one column: the windows
/// of both lie within a stretch of equal steps. The first 2 (2 reach + 1) records of a stretch and
/// its last 2 reach + 1 are not marked, so that the other rows depend on them alone.
std::vector<bool> repetitions(const LinearFilter& filter, std::span<const double> t) {
  const std::size_t n = t.size(), end = 2 * filter.reach + 1;
  std::vector<bool> repeated(n);
  for (std::size_t first = 0, i = 1; i <= n; ++i) {
    const double step = i < n ? t[first + 1] - t[first] : 0;
    if (i < n && (filter.shift_invariant || std::abs(t[i] - t[i - 1] - step) <= rounding * step))
      continue;
    for (std::size_t k = first + 2 * end; k + end < i; ++k) repeated[k] = true;
    first = i - 1;
  }
  return repeated;
}

}  // namespace

BandMatrix probe(const LinearFilter& filter, std::span<const double> all_times) {
  // A filter depends on differences of times alone, so that repeated rows need not be probed.
  const std::vector<bool> repeated = repetitions(filter, all_times);
  std::vector<double> t;
  double left_out = 0;
  for (std::size_t i = 0; i < all_times.size(); ++i)
    if (repeated[i]) left_out += all_times[i] - all_times[i - 1];
    else t.push_back(all_times[i] - left_out);
  // A row reaches at most 2 * reach to either side (that far only at the ends of the run), so that
  // it responds to only one of several impulses at a distance of 4 * reach + 1.
  const Band rows{t.size(), filter.reach};
  const std::size_t n = t.size(), spacing = std::min(4 * filter.reach + 1, n);
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
  L.reserve(all_times.size(), all.size());
  for (std::size_t i = 0, next = 0; i < all_times.size(); ++i) {
    if (!repeated[i]) ++next;
    const std::size_t k = next - 1;  // the probed row
    L.append(rows.first(k) + i - k, std::span(all).subspan(start[k], start[k + 1] - start[k]));
  }
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
