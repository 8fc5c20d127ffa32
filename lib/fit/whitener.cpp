#include "fit/whitener.h"

#include "base/error.h"
#include "fit/dot.h"

#include <algorithm>
#include <cmath>

namespace rolling {
namespace {

/// Element (i, j) of E E^T.
double product(const BandMatrix& E, std::size_t i, std::size_t j) {
  const auto x = E.row(i), y = E.row(j);
  const std::size_t from = std::max(E.first(i), E.first(j)),
                    to = std::min(E.first(i) + x.size(), E.first(j) + y.size());
  return from < to ? dot(&x[from - E.first(i)], &y[from - E.first(j)], to - from) : 0;
}

/// One more than the largest distance of two of the first n rows of E that share a column.
std::size_t band_of(const BandMatrix& E, std::size_t n) {
  std::vector<std::size_t> first_row;  // that reaches a column
  std::size_t band = 1;
  for (std::size_t i = 0; i < n; ++i) {
    first_row.resize(std::max(first_row.size(), E.first(i) + E.row(i).size()), n);
    for (std::size_t j = E.first(i); j < E.first(i) + E.row(i).size(); ++j) {
      first_row[j] = std::min(first_row[j], i);
      band = std::max(band, i - first_row[j] + 1);
    }
  }
  return band;
}

}  // namespace

Whitener::Whitener(const BandMatrix& E, double floor, bool border)
    : n_(E.rows() - border), band_(band_of(E, n_)), floor_(floor), R_(n_ * band_) {
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = i; j < std::min(i + band_, n_); ++j)
      R_[i * band_ + j - i] = product(E, i, j) + (i == j ? floor * floor : 0);
  for (std::size_t k = 0; k < n_; ++k) {
    double* const R = &R_[k * band_];
    if (!(R[0] > 0)) fail("the filters leave a column without noise");
    const double inverse = 1 / std::sqrt(R[0]);
    for (std::size_t j = 0; j < band_; ++j) R[j] *= inverse;
    for (std::size_t i = 1; i < std::min(band_, n_ - k); ++i)
      for (std::size_t j = i; j < band_; ++j) R[i * band_ + j - i] -= R[i] * R[j];
  }
  if (!border) return;
  border_.resize(n_);
  for (std::size_t i = 0; i < n_; ++i) border_[i] = product(E, i, n_);
  apply(border_);
  const double rest = product(E, n_, n_) - dot(border_.data(), border_.data(), n_);
  if (!(rest > 0)) fail("the filters leave a column without noise");
  corner_ = std::sqrt(rest);
}

void Whitener::apply(std::span<double> X) const {
  const std::size_t rows = n_ + (corner_ > 0);
  for (std::size_t k = 0; k < n_; ++k) {
    const double* const R = &R_[k * band_];
    const std::size_t end = std::min(band_, n_ - k);
    for (std::size_t at = k; at < X.size();
         at += rows) {  // all columns at once: the steps of one wait for each other
      double* const x = &X[at];
      const double z = x[0] /= R[0];
      for (std::size_t j = 1; j < end; ++j) x[j] -= R[j] * z;
    }
  }
  if (corner_ > 0)
    for (std::size_t at = 0; at < X.size(); at += rows)
      X[at + n_] = (X[at + n_] - dot(border_.data(), &X[at], n_)) / corner_;
}

void Whitener::apply_transposed(std::span<double> x) const {
  if (corner_ > 0) {
    x[n_] /= corner_;
    for (std::size_t i = 0; i < n_; ++i) x[i] -= border_[i] * x[n_];
  }
  for (std::size_t k = n_; k-- > 0;) {
    const double* const R = &R_[k * band_];
    const std::size_t end = std::min(band_, n_ - k);
    for (std::size_t j = 1; j < end; ++j) x[k] -= R[j] * x[k + j];
    x[k] /= R[0];
  }
}

double Whitener::log_size() const {
  double sum = corner_ > 0 ? std::log(corner_) : 0;
  for (std::size_t k = 0; k < n_; ++k) sum += std::log(R_[k * band_]);
  return sum;
}

/// Of Z = (R^T R)^-1 the elements within the band follow from below, row by row (Erisman and Tinney
/// 1975, Commun. ACM 18, 177): R Z = R^-T is 0 above the diagonal and 1/R(k,k) on it.
double Whitener::trace_of_inverse() const {
  const std::size_t w = band_;
  std::vector<double> Z(w *
                        w);  // Z(k + i, k + j) for i <= j stands in row (k + i) mod w, place j - i
  const auto at = [&](std::size_t i, std::size_t j) -> double& {
    return Z[std::min(i, j) % w * w + (std::max(i, j) - std::min(i, j))];
  };
  double trace = 0;
  for (std::size_t k = n_; k-- > 0;) {
    const double* const R = &R_[k * w];
    const std::size_t end = std::min(w, n_ - k);
    for (std::size_t j = end; j-- > 0;) {
      double sum = j == 0 ? 1 / R[0] : 0;
      for (std::size_t i = 1; i < end; ++i) sum -= R[i] * at(k + i, k + j);
      at(k, k + j) = sum / R[0];
    }
    trace += at(k, k);
  }
  return trace;
}

double Whitener::trace() const {
  double of_inverse = trace_of_inverse();
  if (corner_ > 0) {  // beside it stands u u^T / corner^2, R u = border
    std::vector<double> u = border_;
    u.push_back(0);
    apply_transposed(u);
    of_inverse += dot(u.data(), u.data(), n_) / (corner_ * corner_);
  }
  return static_cast<double>(n_ + (corner_ > 0)) - floor_ * floor_ * of_inverse;
}

}  // namespace rolling
