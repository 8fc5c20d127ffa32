#include "fit/band_matrix.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace rolling {

BandMatrix BandMatrix::identity(std::size_t n) {
  BandMatrix I;
  I.reserve(n, n);
  constexpr double one = 1;
  for (std::size_t i = 0; i < n; ++i) I.append(i, {&one, 1});
  return I;
}

bool BandMatrix::is_identity() const {
  for (std::size_t i = 0; i < rows(); ++i)
    if (row(i).size() != 1 || first_[i] != i || row(i)[0] != 1) return false;
  return true;
}

void BandMatrix::reserve(std::size_t rows, std::size_t numbers) {
  first_.reserve(rows);
  start_.reserve(rows + 1);
  values_.reserve(numbers);
}

void BandMatrix::append(std::size_t first, std::span<const double> values) {
  while (!values.empty() && values.back() == 0) values = values.first(values.size() - 1);
  while (!values.empty() && values.front() == 0) values = values.subspan(1), ++first;
  first_.push_back(first);
  values_.insert(values_.end(), values.begin(), values.end());
  start_.push_back(values_.size());
  if (!values.empty()) columns_ = std::max(columns_, first + values.size());
}

void BandMatrix::append(std::size_t i, double x, const BandMatrix& X, double y,
                        const BandMatrix& Y) {
  const auto a = X.row(i), b = Y.row(i);
  const std::size_t from = std::min(X.first(i), Y.first(i));
  std::vector<double> sum(std::max(X.first(i) + a.size(), Y.first(i) + b.size()) - from, 0);
  for (std::size_t j = 0; j < a.size(); ++j) sum[X.first(i) - from + j] += x * a[j];
  for (std::size_t j = 0; j < b.size(); ++j) sum[Y.first(i) - from + j] += y * b[j];
  append(from, sum);
}

double BandMatrix::times(std::size_t i, std::span<const double> x) const {
  const auto r = row(i);
  return std::inner_product(r.begin(), r.end(), x.begin() + static_cast<std::ptrdiff_t>(first_[i]),
                            0.0);
}

std::vector<double> BandMatrix::transposed_times(std::span<const double> x) const {
  std::vector<double> product(columns_);
  for (std::size_t i = 0; i < rows(); ++i) {
    const auto r = row(i);
    for (std::size_t k = 0; k < r.size(); ++k) product[first_[i] + k] += r[k] * x[i];
  }
  return product;
}

BandMatrix BandMatrix::operator*(const BandMatrix& B) const {
  // The columns that row i of the product reaches.
  const auto reach = [&](std::size_t i) {
    std::size_t from = B.rows() ? SIZE_MAX : 0, to = 0;
    for (std::size_t k = first_[i]; k < first_[i] + row(i).size(); ++k) {
      if (B.row(k).empty()) continue;
      from = std::min(from, B.first(k));
      to = std::max(to, B.first(k) + B.row(k).size());
    }
    return std::pair(from, to);
  };
  std::size_t numbers = 0;
  for (std::size_t i = 0; i < rows(); ++i) {
    const auto [from, to] = reach(i);
    numbers += to > from ? to - from : 0;
  }
  BandMatrix product;
  product.reserve(rows(), numbers);
  std::vector<double> sum;
  for (std::size_t i = 0; i < rows(); ++i) {
    const auto r = row(i);
    const auto [from, to] = reach(i);
    sum.assign(to > from ? to - from : 0, 0);
    for (std::size_t k = 0; k < r.size(); ++k) {
      const auto b = B.row(first_[i] + k);
      for (std::size_t j = 0; j < b.size(); ++j)
        sum[B.first(first_[i] + k) - from + j] += r[k] * b[j];
    }
    product.append(sum.empty() ? 0 : from, sum);
  }
  return product;
}

BandMatrix BandMatrix::without(std::size_t before, std::size_t after) const {
  BandMatrix rest;
  for (std::size_t i = before; i + after < rows(); ++i) rest.append(first(i), row(i));
  return rest;
}

}  // namespace rolling
