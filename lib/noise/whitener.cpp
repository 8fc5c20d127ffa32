// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/whitener.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/matrix.h"

namespace rolling {
namespace {

/// The width of the upper band of E E^T: one more than the largest distance between two of the
/// first n rows of E with a common column.
std::size_t band_of(const FilterMatrix& E, std::size_t n) {
  std::vector<std::uint32_t> first_row(E.columns(), UINT32_MAX);  // of each column
  std::size_t band = 1;
  FilterMatrix::Range columns{};
  for (std::size_t i = 0; i < n; ++i) {
    if (E.repeats(i)) ++columns.first, ++columns.end;
    else columns = E.columns_of(i);
    for (std::size_t j = columns.first; j < columns.end; ++j) {
      first_row[j] = std::min(first_row[j], static_cast<std::uint32_t>(i));
      band = std::max(band, i - first_row[j] + 1);
    }
  }
  return band;
}

}  // namespace

Covariance::Covariance(const FilterMatrix& E, std::size_t n_rows)
    : n(n_rows), band(band_of(E, n)), rows(n * band) {
  std::vector<FilterMatrix::Row> last(band);  // a ring of rows of E
  std::size_t same = 0;  // number of rows up to this one that repeat the row before
  for (std::size_t i = 0; i < n; ++i) {
    FilterMatrix::Row& row = last[i % band];
    if (E.repeats(i)) {
      row = last[(i - 1) % band];
      ++row.first, ++same;
    } else {
      E.row(i, row);
      same = 0;
    }
    for (std::size_t j = i < band ? 0 : i - band + 1; j <= i; ++j)
      rows[j * band + i - j] =
          i - j < same ? rows[(j - 1) * band + i - j] : dot(row, last[j % band]);
  }
}

Whitener::Whitener(Covariance of_E, double share)
    : n_(of_E.n), band_(of_E.band), R_(std::move(of_E.rows)) {
  const double width = static_cast<double>(band_);
  white_ = share * share + width * width * std::numeric_limits<double>::epsilon();
  for (std::size_t k = 0; k < n_; ++k) R_[k * band_] *= 1 + white_;
  for (std::size_t k = 0; k < n_; ++k) {
    double* const R = &R_[k * band_];
    if (!(R[0] > 0)) fail("the filters leave a column without noise");
    const double inverse = 1 / std::sqrt(R[0]);
    for (std::size_t j = 0; j < band_; ++j) R[j] *= inverse;
    for (std::size_t i = 1; i < std::min(band_, n_ - k); ++i)
      for (std::size_t j = i; j < band_; ++j) R[i * band_ + j - i] -= R[i] * R[j];
  }
}

double Whitener::variance(std::size_t i) const {
  double sum = 0;  // of the squares in column i of R
  for (std::size_t j = 0; j < std::min(i + 1, band_); ++j)
    sum += R_[(i - j) * band_ + j] * R_[(i - j) * band_ + j];
  return sum / (1 + white_);
}

Whitener::Pass::Pass(const Whitener& by, std::size_t stride)
    : by_(by), stride_(stride), done_((by.band_ + 256) * stride) {}

void Whitener::Pass::push(double* row) {
  const std::size_t band = by_.band_;
  if ((k_ - base_ + 1) * stride_ > done_.size()) {
    const std::size_t kept = band - 1;
    std::copy_n(done_.end() - static_cast<std::ptrdiff_t>(kept * stride_), kept * stride_,
                done_.begin());
    base_ = k_ - kept;
  }
  const double* const R = &by_.R_[k_ * band];
  double* const last = &done_[(k_ - base_) * stride_];
  for (std::size_t c = 0; c < stride_; c += 2) {  // two columns fill one vector register
    double x = row[c], y = row[c + 1];
    const double* above = R;  // up the column of R
    const double* of = last + c;
    for (std::size_t j = std::min(k_ + 1, band); j-- > 1;) {
      above -= band - 1;
      of -= stride_;
      x -= *above * of[0];
      y -= *above * of[1];
    }
    last[c] = row[c] = x / R[0];
    last[c + 1] = row[c + 1] = y / R[0];
  }
  ++k_;
}

void Whitener::apply(std::span<double> X) const {
  const std::size_t columns = X.size() / n_, stride = FilterPass::stride(columns);
  Pass pass(*this, stride);
  std::vector<double> row(stride);
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t c = 0; c < columns; ++c) row[c] = X[c * n_ + i];
    pass.push(row.data());
    for (std::size_t c = 0; c < columns; ++c) X[c * n_ + i] = row[c];
  }
}

void Whitener::apply_transposed(std::span<double> x) const {
  for (std::size_t k = n_; k-- > 0;) {
    const double* const R = &R_[k * band_];
    double sum = x[k];  // from the far end of the row: the sum waits for x[k + 1] last
    for (std::size_t j = std::min(band_, n_ - k); j-- > 1;) sum -= R[j] * x[k + j];
    x[k] = sum / R[0];
  }
}

std::vector<double> Whitener::undo(std::span<const double> f) const {
  std::vector<double> all(n_);
  for (std::size_t k = 0; k < n_; ++k)
    for (std::size_t j = 0; j < std::min(band_, n_ - k); ++j)
      all[k + j] += R_[k * band_ + j] * f[k];
  return all;
}

double Whitener::log_size() const {
  double sum = 0;
  for (std::size_t k = 0; k < n_; ++k) sum += std::log(R_[k * band_]);
  return sum;
}

/// R^-T E E^T R^-1 = I - R^-T F R^-1, and tr R^-T F R^-1 = tr F Z with Z = (R^T R)^-1. The elements
/// of Z within the band follow from the last row upwards (Erisman and Tinney 1975, Commun. ACM 18,
/// 177), because R Z = R^-T is 0 above the diagonal and 1/R(k,k) on it.
double Whitener::trace() const {
  const std::size_t w = band_;
  // Z(i, j) is stored in row i mod w at place w + j - i, for columns on both sides of the diagonal.
  std::vector<double> Z(w * 2 * w);
  std::vector<double*> rows(w);  // rows k, k + 1, ... of Z
  double of_F = 0;
  for (std::size_t k = n_; k-- > 0;) {
    const double* const R = &R_[k * w];
    const std::size_t end = std::min(w, n_ - k);
    for (std::size_t j = 0, slot = k % w; j < end; ++j, slot = slot + 1 == w ? 0 : slot + 1)
      rows[j] = &Z[slot * 2 * w + w];
    for (std::size_t j = end; j-- > 1;)
      rows[0][j] = *(rows[j] - j) = -dot(R + 1, rows[j] - j + 1, end - 1) / R[0];
    rows[0][0] = (1 / R[0] - dot(R + 1, rows[0] + 1, end - 1)) / R[0];
    of_F += white_ * variance(k) * rows[0][0];
  }
  return static_cast<double>(n_) - of_F;
}

}  // namespace rolling
