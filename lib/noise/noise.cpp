// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/matrix.h"

namespace rolling {
namespace {

/// The width of the upper band of E E^T: one more than the largest distance between two rows of E
/// with a common column.
std::size_t band_of(const BandMatrix& E) {
  std::vector<std::size_t> first_row(E.columns(), E.rows());  // of each column
  std::size_t band = 1;
  for (std::size_t i = 0; i < E.rows(); ++i)
    for (std::size_t j = E.first(i); j < E.end(i); ++j) {
      first_row[j] = std::min(first_row[j], i);
      band = std::max(band, i - first_row[j] + 1);
    }
  return band;
}

}  // namespace

Covariance::Covariance(const BandMatrix& E) : n(E.rows()), band(band_of(E)), rows(n * band) {
  std::size_t same = 0;  // number of rows up to this one that repeat the row before
  for (std::size_t i = 0; i < n; ++i) {
    same = E.repeats(i) ? same + 1 : 0;
    for (std::size_t j = i < band ? 0 : i - band + 1; j <= i; ++j)
      rows[j * band + i - j] = i - j < same ? rows[(j - 1) * band + i - j] : dot(E, i, E, j);
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

void Whitener::apply(std::span<double> X) const {
  for (std::size_t k = 0; k < n_; ++k) {
    const double* const R = &R_[k * band_];
    const std::size_t end = std::min(band_, n_ - k);
    for (std::size_t at = k; at < X.size(); at += n_) {
      double* const x = &X[at];
      x[0] /= R[0];
      for (std::size_t j = 1; j < end; ++j) x[j] -= R[j] * x[0];
    }
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

double Whitener::log_size() const {
  double sum = 0;
  for (std::size_t k = 0; k < n_; ++k) sum += std::log(R_[k * band_]);
  return sum;
}

namespace {

/// Concatenates the results of function(run number, part) for the parts of the runs.
std::vector<double> each(const auto& parts, auto&& function) {
  std::vector<double> result;
  for (std::size_t r = 0; r < parts.size(); ++r) {
    std::vector<double> part = function(r, parts[r]);
    if (result.empty()) result = std::move(part);
    else result.insert(result.end(), part.begin(), part.end());
  }
  return result;
}

}  // namespace

Noise::Noise(std::vector<Filters> E, AddedNoise added) : E_(std::move(E)), added_(added) {
  for (const Filters& E_of_run : E_) {
    rows_.push_back(E_of_run->rows());
    sources_.push_back(E_of_run->columns());
    whiteners_.emplace_back(Covariance(*E_of_run), added.share);
  }
}

std::vector<double> Noise::to_sources(std::vector<double> x) const {
  return each(by_run(x, rows_), [&](std::size_t r, auto of_run) {
    whiteners_[r].apply_transposed(of_run);
    return E_[r]->transposed_times(of_run);
  });
}

std::size_t Noise::informative() const {
  std::size_t count = 0;
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (std::size_t i = 0; i < rows_[r]; ++i) count += whiteners_[r].informative(i);
  return count;
}

std::vector<double> Noise::innovations(const std::vector<double>& f,
                                       std::vector<std::size_t>& runs) const {
  runs.clear();
  return each(by_run(f, rows_), [&](std::size_t r, auto f_of) {
    std::vector<double> few;
    few.reserve(f_of.size());
    for (std::size_t i = 0; i < rows_[r]; ++i)
      if (whiteners_[r].informative(i)) few.push_back(f_of[i]);
    runs.push_back(few.size());
    return few;
  });
}

}  // namespace rolling
