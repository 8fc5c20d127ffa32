// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/filter_matrix.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/matrix.h"

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
  if (values.empty()) first = 0;
  if (std::max({rows() + 1, first + values.size(), values_.size() + values.size()}) > UINT32_MAX)
    fail("a filter of more than {} numbers", UINT32_MAX);  // GCOVR_EXCL_LINE: takes 32 GB
  const bool same = !rows_.empty() && std::ranges::equal(row(rows() - 1), values);
  const auto before = static_cast<std::uint32_t>(rows() - first);
  if (!same || shapes_.back().before != before) {
    const auto start = same ? shapes_.back().start : static_cast<std::uint32_t>(values_.size());
    if (!same) values_.insert(values_.end(), values.begin(), values.end());
    shapes_.push_back({before, start, static_cast<std::uint32_t>(values.size())});
  }
  rows_.push_back(static_cast<std::uint32_t>(shapes_.size() - 1));
  columns_ = std::max(columns_, first + values.size());
  window_ = std::max(window_, columns_ - first);
}

BandMatrix BandMatrix::of_rows(std::span<const std::size_t> rows) const {
  BandMatrix few;
  few.reserve(rows.size(), 0);
  for (std::size_t i : rows) few.append(first(i), row(i));
  return few;
}

FilterMatrix::FilterMatrix(BandMatrix L) : columns_(L.columns()) {
  factors_.push_back(std::make_shared<const BandMatrix>(std::move(L)));
}

FilterMatrix FilterMatrix::then(BandMatrix L) const {
  FilterMatrix product = *this;
  if (factors_.size() == 1 && factors_[0]->is_identity()) product.factors_.clear();
  const auto same = std::ranges::find(
      factors_, L, [](const auto& f) -> auto& { return *f; });
  product.factors_.push_back(
      same != factors_.end() ? *same : std::make_shared<const BandMatrix>(std::move(L)));
  return product;
}

FilterMatrix FilterMatrix::of_rows(std::span<const std::size_t> rows) const {
  FilterMatrix few = *this;
  few.factors_.back() = std::make_shared<const BandMatrix>(factors_.back()->of_rows(rows));
  return few;
}

namespace {

/// The columns of L in which one of these rows has an element.
FilterMatrix::Range columns_of_rows(const BandMatrix& L, FilterMatrix::Range rows) {
  FilterMatrix::Range columns{SIZE_MAX, 0};
  for (std::size_t k = rows.first; k < rows.end; ++k)
    if (!L.row(k).empty())
      columns = {std::min(columns.first, L.first(k)), std::max(columns.end, L.end(k))};
  return {std::min(columns.first, columns.end), columns.end};
}

}  // namespace

FilterMatrix::Range FilterMatrix::columns_of(std::size_t i) const {
  Range range{i, i + 1};
  for (std::size_t f = factors_.size(); f-- > 0;) range = columns_of_rows(*factors_[f], range);
  return range;
}

void FilterMatrix::row(std::size_t i, Row& to) const {
  const auto last = factors_.back()->row(i);
  to.first = factors_.back()->first(i);
  to.values.assign(last.begin(), last.end());
  std::vector<double>& sum = to.spare;
  for (std::size_t f = factors_.size() - 1; f-- > 0;) {
    const BandMatrix& L = *factors_[f];
    const auto [first, end] = columns_of_rows(L, {to.first, to.end()});
    sum.assign(end - first, 0);
    for (std::size_t k = to.first; k < to.end(); ++k) {
      const auto row = L.row(k);
      const double by = to.values[k - to.first];
      if (row.empty()) continue;
      double* const at = &sum[L.first(k) - first];
      for (std::size_t j = 0; j < row.size(); ++j) at[j] += by * row[j];
    }
    to.first = first;
    to.values.swap(sum);
  }
}

bool FilterMatrix::repeats(std::size_t i) const {
  std::size_t first = i, end = i + 1;  // the rows of a factor that row i of the product needs
  for (std::size_t f = factors_.size(); f-- > 0;) {
    const BandMatrix& L = *factors_[f];
    for (std::size_t k = first; k < end; ++k)
      if (!L.repeats(k)) return false;
    first = L.first(first), end = L.end(end - 1);
  }
  return true;
}

std::vector<double> FilterMatrix::times(std::span<const double> x) const {
  std::vector<double> all;
  all.reserve(rows());
  FilterPass pass(*this, 1, [&](const double* row) { all.push_back(*row); });
  for (double value : x) {
    *pass.place() = value;
    pass.push();
  }
  return all;
}

std::vector<double> FilterMatrix::transposed_times(std::vector<double> x) const {
  for (std::size_t f = factors_.size(); f-- > 0;) {
    const BandMatrix& L = *factors_[f];
    std::vector<double> next(f > 0 ? factors_[f - 1]->rows() : columns_);
    for (std::size_t i = 0; i < L.rows(); ++i) {
      const auto row = L.row(i);
      double* const to = next.data() + L.first(i);
      for (std::size_t k = 0; k < row.size(); ++k) to[k] += row[k] * x[i];
    }
    x.swap(next);
  }
  return x;
}

double dot(const FilterMatrix::Row& x, const FilterMatrix::Row& y) {
  const std::size_t from = std::max(x.first, y.first), to = std::min(x.end(), y.end());
  return from < to ? dot(&x.values[from - x.first], &y.values[from - y.first], to - from) : 0;
}

FilterPass::FilterPass(const FilterMatrix& H, std::size_t columns,
                       std::function<void(double* row)> take)
    : stride_(stride(columns)), product_(stride_), take_(std::move(take)) {
  constexpr std::size_t room = 256;  // rows between two moves of the kept rows to the front
  for (const auto& L : H.factors_)
    stages_.push_back({L.get(), std::vector<double>((L->window() + room) * stride_)});
}

/// The memory for the next input row of a stage; behind the last one, for a row of the product.
double* FilterPass::place(std::size_t stage) {
  if (stage == stages_.size()) return product_.data();
  Stage& s = stages_[stage];
  if ((s.count - s.base + 1) * stride_ > s.in.size()) {
    const std::size_t kept = std::min(s.L->window(), s.count - s.base);
    const auto end = s.in.begin() + static_cast<std::ptrdiff_t>((s.count - s.base) * stride_);
    std::copy(end - static_cast<std::ptrdiff_t>(kept * stride_), end, s.in.begin());
    s.base = s.count - kept;
  }
  return &s.in[(s.count - s.base) * stride_];
}

void FilterPass::push(std::size_t stage) {
  if (stage == stages_.size()) return take_(product_.data());
  Stage& s = stages_[stage];
  ++s.count;
  for (; s.row < s.L->rows() && s.L->end(s.row) <= s.count; ++s.row) {
    multiply(s, place(stage + 1));
    push(stage + 1);
  }
}

void FilterPass::multiply(const Stage& s, double* out) const {
  const auto row = s.L->row(s.row);
  const std::size_t from = row.empty() ? 0 : s.L->first(s.row) - s.base;
  for (std::size_t c = 0; c < stride_; c += 2) {  // two columns fill one vector register
    const double* x = &s.in[from * stride_ + c];
    double sum[4]{};
    std::size_t k = 0;
    for (; k + 2 <= row.size(); k += 2, x += 2 * stride_) {
      sum[0] += row[k] * x[0], sum[1] += row[k] * x[1];
      sum[2] += row[k + 1] * x[stride_], sum[3] += row[k + 1] * x[stride_ + 1];
    }
    if (k < row.size()) sum[0] += row[k] * x[0], sum[1] += row[k] * x[1];
    out[c] = sum[0] + sum[2];
    out[c + 1] = sum[1] + sum[3];
  }
}

}  // namespace rolling
