// SPDX-License-Identifier: GPL-3.0-or-later
// Least squares of a polynomial in time, reading by reading.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "base/estimate.h"

namespace rolling {

/// True if a number is far from 0 for its error.
inline bool is_known(const Estimate& x) { return std::abs(x.value) > 3 * x.sigma; }

/// The polynomial of P coefficients that is nearest to readings of equal weight. Givens rotations
/// of the rows (1, u, u^2, ... | y) update the triangular factor: no normal equations, whose
/// cumulative sums would lose the digits of short pieces of a long run. O(P^2) a reading.
template <std::size_t P>
class Polynomial {
 public:
  void add(double u, double y) {
    std::array<double, P> row;
    row[0] = 1;
    for (std::size_t k = 1; k < P; ++k) row[k] = row[k - 1] * u;
    add(row, y);
  }
  /// The same for other functions than powers.
  void add(std::array<double, P> row, double y) {
    for (std::size_t k = 0; k < P; ++k) {
      if (row[k] == 0) continue;
      const double length = std::sqrt(r_[k][k] * r_[k][k] + row[k] * row[k]);
      const double c = r_[k][k] / length;
      const double s = row[k] / length;
      r_[k][k] = length;
      for (std::size_t j = k + 1; j < P; ++j) turn(c, s, r_[k][j], row[j]);
      turn(c, s, z_[k], y);
    }
    rss_ += y * y;
    ++size_;
  }
  std::size_t size() const { return size_; }
  double rss() const { return rss_; }  ///< 0 for P readings or fewer
  /// That of the first `order` coefficients alone: the factor holds all of these polynomials.
  double rss(std::size_t order) const {
    double sum = rss_;
    for (std::size_t k = order; k < P; ++k) sum += z_[k] * z_[k];
    return sum;
  }

  /// A derivative at u, and its standard error for readings of standard deviation 1; infinite if
  /// the readings do not determine the polynomial.
  Estimate derivative(std::size_t order, double u, std::size_t size = P) const {
    if (size_ < size) return {0, INFINITY};
    std::array<double, P> w{};  // R^T w = d/du^order (1, u, u^2, ...)
    double value = 0;
    double square = 0;
    double power = 1;
    for (std::size_t k = 0; k < size; ++k) {
      if (k >= order) {
        w[k] = power;
        for (std::size_t j = k; j > k - order; --j) w[k] *= static_cast<double>(j);
        power *= u;
      }
      for (std::size_t j = 0; j < k; ++j) w[k] -= r_[j][k] * w[j];
      w[k] /= r_[k][k];
      value += w[k] * z_[k];
      square += w[k] * w[k];
    }
    return {value, std::sqrt(square)};
  }

 private:
  static void turn(double c, double s, double& a, double& b) {
    const double old = a;
    a = c * old + s * b;
    b = c * b - s * old;
  }

  std::array<std::array<double, P>, P> r_{};
  std::array<double, P> z_{};
  double rss_ = 0;
  std::size_t size_ = 0;
};

}  // namespace rolling
