#include "fit/band_matrix.h"

#include "base/error.h"

#include <algorithm>

namespace rolling {

BandMatrix BandMatrix::identity(std::size_t n) {
  BandMatrix I;
  I.reserve(n, 1);
  constexpr double one = 1;
  for (std::size_t i = 0; i < n; ++i) I.append(i, {&one, 1});
  return I;
}

bool BandMatrix::is_identity() const {
  for (std::size_t i = 0; i < rows(); ++i)
    if (row(i).size() != 1 || first(i) != i || row(i)[0] != 1) return false;
  return true;
}

void BandMatrix::reserve(std::size_t rows, std::size_t numbers) {
  rows_.reserve(rows);
  values_.reserve(numbers);
}

void BandMatrix::append(std::size_t first, std::span<const double> values) {
  while (!values.empty() && values.back() == 0) values = values.first(values.size() - 1);
  while (!values.empty() && values.front() == 0) values = values.subspan(1), ++first;
  if (values.empty()) {
    rows_.push_back({0, 0, 0});
    return;
  }
  const auto before = rows_.empty() ? std::span<const double>() : row(rows() - 1);
  const std::size_t start =
      std::ranges::equal(before, values) ? rows_.back().start : values_.size();
  if (first + values.size() > UINT32_MAX || start + values.size() > UINT32_MAX)
    fail("a filter of more than {} numbers", UINT32_MAX);  // GCOVR_EXCL_LINE: takes 32 GB
  if (start == values_.size()) values_.insert(values_.end(), values.begin(), values.end());
  rows_.push_back({static_cast<std::uint32_t>(start), static_cast<std::uint32_t>(first),
                   static_cast<std::uint32_t>(values.size())});
  columns_ = std::max(columns_, first + values.size());
  window_ = std::max(window_, columns_ - first);
}

BandMatrix BandMatrix::of_rows(std::span<const std::size_t> rows) const {
  BandMatrix few;
  few.reserve(rows.size(), 0);
  for (std::size_t i : rows) few.append(first(i), row(i));
  return few;
}

}  // namespace rolling
