#include "fit/whitener.h"

#include <algorithm>
#include <cmath>

namespace rolling {

namespace {

/// The rows of E that a source reaches into: from, and before to.
struct Reach {
  std::size_t from, to;
};
std::vector<Reach> reaches(const BandMatrix& E) {
  std::vector<Reach> of;
  for (std::size_t i = 0; i < E.rows(); ++i) {
    of.resize(std::max(of.size(), E.first(i) + E.row(i).size()), {E.rows(), 0});
    for (std::size_t j = E.first(i); j < E.first(i) + E.row(i).size(); ++j)
      of[j] = {std::min(of[j].from, i), i + 1};
  }
  return of;
}

/// Element (i, j) of E E^T.
double product(const BandMatrix& E, std::size_t i, std::size_t j) {
  const auto x = E.row(i), y = E.row(j);
  const std::size_t from = std::max(E.first(i), E.first(j)),
                    to = std::min(E.first(i) + x.size(), E.first(j) + y.size());
  double sum = 0;
  for (std::size_t k = from; k < to; ++k) sum += x[k - E.first(i)] * y[k - E.first(j)];
  return sum;
}

}  // namespace

Whitener::Whitener(const BandMatrix& E, double floor) : n_(E.rows()), band_(1) {
  for (const auto& [from, to] : reaches(E))
    if (from < to) band_ = std::max(band_, to - from);
  set_floor(E, floor);
}

void Whitener::set_floor(const BandMatrix& E, double floor) {
  R_.assign(n_ * band_, 0);
  double largest = 0;
  for (std::size_t i = 0; i < n_; ++i) largest = std::max(largest, product(E, i, i));
  // Cholesky is several times faster, but sees the square of E's condition, which this floor keeps
  // below 1e8 or so.
  if (floor * floor > 1e-8 * largest) factor(E, floor);
  else triangulate(E, floor);
}

void Whitener::factor(const BandMatrix& E, double floor) {
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = i; j < std::min(i + band_, n_); ++j)
      R_[i * band_ + j - i] = product(E, i, j) + (i == j ? floor * floor : 0);
  for (std::size_t k = 0; k < n_; ++k) {
    double* const R = &R_[k * band_];
    const double inverse = 1 / std::sqrt(R[0]);
    for (std::size_t j = 0; j < band_; ++j) R[j] *= inverse;
    for (std::size_t i = 1; i < std::min(band_, n_ - k); ++i)
      for (std::size_t j = i; j < band_; ++j) R[i * band_ + j - i] -= R[i] * R[j];
  }
}

void Whitener::triangulate(const BandMatrix& E, double floor) {
  // The rows of E^T (one for each source record) and of floor * I, sorted by the first column that
  // they touch: in that order Givens rotations never fill beyond the band.
  const std::vector<Reach> of = reaches(E);
  std::vector<std::size_t> order;
  for (std::size_t j = 0; j < of.size(); ++j)
    if (of[j].from < of[j].to) order.push_back(j);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return of[i].from < of[j].from; });
  std::vector<double> row(n_ + band_, 0);  // the row that is being rotated in, by column
  const auto rotate_in = [&](std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < end; ++k) {
      if (row[k] == 0) continue;
      double* const R = &R_[k * band_];
      if (R[0] == 0) {  // nothing ends here yet: the row moves in
        std::copy_n(&row[k], band_, R);
        std::fill_n(&row[k], band_, 0.0);
        return;
      }
      const double inverse = 1 / std::sqrt(R[0] * R[0] + row[k] * row[k]), c = R[0] * inverse,
                   s = row[k] * inverse;
      for (std::size_t j = 0; j < band_; ++j) {
        const double r = R[j], x = row[k + j];
        R[j] = c * r + s * x;
        row[k + j] = c * x - s * r;
      }
      row[k] = 0;
      end = std::min(n_, std::max(end, k + band_));
    }
  };
  std::size_t next = 0;
  for (std::size_t k = 0; k < n_; ++k) {
    for (; next < order.size() && of[order[next]].from == k; ++next) {
      const std::size_t j = order[next];
      for (std::size_t i = k; i < of[j].to; ++i)
        if (j >= E.first(i) && j < E.first(i) + E.row(i).size()) row[i] = E.row(i)[j - E.first(i)];
      rotate_in(k, of[j].to);
    }
    if (floor > 0) {
      row[k] = floor;
      rotate_in(k, k + 1);
    }
  }
  // A pivot of rounding size: this residual is a sum of those before it and has no noise of its
  // own. The rest of its row belongs to the rows below.
  for (std::size_t k = 0; k < n_; ++k) {
    double squares = 0;  // of its column
    for (std::size_t i = k >= band_ ? k - band_ + 1 : 0; i <= k; ++i)
      squares += R_[i * band_ + k - i] * R_[i * band_ + k - i];
    double* const R = &R_[k * band_];
    if (std::abs(R[0]) > 1e-12 * std::sqrt(squares)) continue;
    std::copy_n(R, band_, &row[k]);
    std::fill_n(R, band_, 0.0);
    row[k] = 0;
    rotate_in(k + 1, std::min(n_, k + band_));
    std::fill(row.begin() + static_cast<std::ptrdiff_t>(k), row.end(), 0.0);
  }
}

void Whitener::apply(std::span<double> X) const {
  for (std::size_t k = 0; k < n_; ++k) {
    const double* const R = &R_[k * band_];
    const std::size_t end = std::min(band_, n_ - k);
    for (std::size_t at = k; at < X.size();
         at += n_) {  // of all columns at once: the steps of one wait for each other
      double* const x = &X[at];
      const double z = x[0] = R[0] == 0 ? 0 : x[0] / R[0];
      for (std::size_t j = 1; j < end; ++j) x[j] -= R[j] * z;
    }
  }
}

void Whitener::apply_transposed(std::span<double> x) const {
  for (std::size_t k = n_; k-- > 0;) {
    const double* const R = &R_[k * band_];
    const std::size_t end = std::min(band_, n_ - k);
    for (std::size_t j = 1; j < end; ++j) x[k] -= R[j] * x[k + j];
    x[k] = R[0] == 0 ? 0 : x[k] / R[0];
  }
}

double Whitener::log_size() const {
  double sum = 0;
  for (std::size_t k = 0; k < n_; ++k) sum += std::log(std::abs(R_[k * band_]));
  return sum;
}

}  // namespace rolling
