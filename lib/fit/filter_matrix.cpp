#include "fit/filter_matrix.h"

#include <algorithm>
#include <utility>

namespace rolling {

FilterMatrix::FilterMatrix(BandMatrix L) : columns_(L.columns()) {
  factors_.push_back(std::make_shared<const BandMatrix>(std::move(L)));
}

FilterMatrix FilterMatrix::identity(std::size_t n) { return FilterMatrix(n); }

FilterMatrix FilterMatrix::then(BandMatrix L) const {
  FilterMatrix product = *this;
  product.factors_.push_back(std::make_shared<const BandMatrix>(std::move(L)));
  return product;
}

FilterMatrix FilterMatrix::of_rows(std::span<const std::size_t> rows) const {
  if (factors_.empty()) return then(BandMatrix::identity(columns_).of_rows(rows));
  FilterMatrix few = *this;
  few.factors_.back() = std::make_shared<const BandMatrix>(factors_.back()->of_rows(rows));
  return few;
}

FilterMatrix FilterMatrix::with_last_row(std::vector<double> row) const {
  FilterMatrix bordered = *this;
  bordered.border_ = std::make_shared<const std::vector<double>>(std::move(row));
  return bordered;
}

void FilterMatrix::row(std::size_t i, Row& to) const {
  if (factors_.empty()) {
    to.first = i;
    to.values.assign(1, 1);
    return;
  }
  const auto last = factors_.back()->row(i);
  to.first = factors_.back()->first(i);
  to.values.assign(last.begin(), last.end());
  std::vector<double>& sum = to.spare;
  for (std::size_t f = factors_.size() - 1; f-- > 0;) {
    const BandMatrix& L = *factors_[f];
    std::size_t first = SIZE_MAX, end = 0;
    for (std::size_t k = to.first; k < to.end(); ++k)
      if (!L.row(k).empty()) first = std::min(first, L.first(k)), end = std::max(end, L.end(k));
    if (first > end) first = end;
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

std::vector<double> FilterMatrix::times(std::span<const double> x) const {
  FilterPass pass(*this, 1);
  std::vector<double> all;
  all.reserve(rows());
  for (double value : x) {
    *pass.place() = value;
    pass.push();
    while (const double* row = pass.next()) all.push_back(*row);
  }
  return all;
}

std::vector<double> FilterMatrix::transposed_times(std::span<const double> X,
                                                   std::size_t columns) const {
  std::vector<double> all(X.begin(),
                          X.begin() + static_cast<std::ptrdiff_t>(band_rows() * columns));
  for (std::size_t f = factors_.size(); f-- > 0;) {
    const BandMatrix& L = *factors_[f];
    std::vector<double> next((f > 0 ? factors_[f - 1]->rows() : columns_) * columns);
    for (std::size_t i = 0; i < L.rows(); ++i) {
      double* to = &next[L.first(i) * columns];
      for (const double by : L.row(i))
        for (std::size_t c = 0; c < columns; ++c) *to++ += by * all[i * columns + c];
    }
    all.swap(next);
  }
  if (bordered())
    for (std::size_t k = 0; k < columns_; ++k)
      for (std::size_t c = 0; c < columns; ++c)
        all[k * columns + c] += (*border_)[k] * X[band_rows() * columns + c];
  return all;
}

FilterPass::FilterPass(const FilterMatrix& H, std::size_t columns)
    : H_(H), stride_((columns + 1) / 2 * 2), raw_(stride_), last_(stride_) {
  constexpr std::size_t room = 256;  // rows between two moves of the kept rows to the front
  for (const auto& L : H.factors_) {
    stages_.push_back({L.get(), {}, 0, 0, 0, std::vector<double>(stride_)});
    stages_.back().in.resize((L->window() + room) * stride_);
  }
}

void FilterPass::push() {
  fresh_ = true;
  if (H_.bordered()) {
    const double by = (*H_.border_)[pushed_];
    for (std::size_t c = 0; c < stride_; ++c) last_[c] += by * raw_[c];
  }
  ++pushed_;
}

double* FilterPass::next() {
  if (double* const row = next_of(stages_.size())) return row;
  if (!H_.bordered() || pushed_ < H_.columns() || std::exchange(last_given_, true)) return nullptr;
  return last_.data();
}

double* FilterPass::next_of(std::size_t stage) {
  if (stage == 0) return std::exchange(fresh_, false) ? raw_.data() : nullptr;
  Stage& s = stages_[stage - 1];
  if (s.row == s.L->rows()) return nullptr;
  while (s.count < s.L->end(s.row)) {
    const double* const in = next_of(stage - 1);
    if (!in) return nullptr;
    if ((s.count - s.base + 1) * stride_ > s.in.size()) {
      const std::size_t kept = std::min(s.L->window(), s.count - s.base);
      const auto end = s.in.begin() + static_cast<std::ptrdiff_t>((s.count - s.base) * stride_);
      std::copy(end - static_cast<std::ptrdiff_t>(kept * stride_), end, s.in.begin());
      s.base = s.count - kept;
    }
    std::copy_n(in, stride_, &s.in[(s.count - s.base) * stride_]);
    ++s.count;
  }
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
    s.out[c] = sum[0] + sum[2];
    s.out[c + 1] = sum[1] + sum[3];
  }
  ++s.row;
  return s.out.data();
}

}  // namespace rolling
