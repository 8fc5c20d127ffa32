// SPDX-License-Identifier: GPL-3.0-or-later
// The residuals of a fit while rows are left out of it, one after another.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/matrix.h"

namespace rolling {

/// As if the fit had been repeated without these rows, to first order around its minimum (Sherman
/// and Morrison 1950, Ann. Math. Stat. 21, 124).
class LeftOut {
 public:
  /// The residuals of the rows, and the columns of B = J R^-1 for them, of n numbers each; without
  /// columns no row has a share in the fit.
  LeftOut(std::span<const double> residuals, std::vector<std::span<const double>> B)
      : e_(residuals), B_(std::move(B)), c_(B_.size()), P_(B_.size() * B_.size()),
        squares_(dot(e_, e_)) {
    for (std::size_t j = 0; j < B_.size(); ++j) P_[j * B_.size() + j] = 1;
  }

  std::size_t rows() const { return e_.size(); }
  /// Of a row that was left out, too: what it is off the prediction of the others.
  double residual(std::size_t i) const {
    double e = e_[i];
    for (std::size_t j = 0; j < B_.size(); ++j) e += B_[j][i] * c_[j];
    return e;
  }
  /// 1 - leverage; 0 where a row alone determines a parameter.
  double left(std::size_t i) const {
    double left = 1;
    const std::vector<double> step = step_of(i);
    for (std::size_t j = 0; j < B_.size(); ++j) left -= B_[j][i] * step[j];
    return left;
  }
  /// The sum of the squares of the others.
  double squares() const { return squares_; }

  void leave_out(std::size_t i) {
    const std::size_t q = B_.size();
    const double e = residual(i), share = left(i);
    const std::vector<double> step = step_of(i);
    squares_ -= e * e / share;
    for (std::size_t j = 0; j < q; ++j) {
      c_[j] += step[j] * e / share;
      for (std::size_t k = 0; k < q; ++k) P_[j * q + k] += step[j] * step[k] / share;
    }
  }

 private:
  std::vector<double> step_of(std::size_t i) const {
    const std::size_t q = B_.size();
    std::vector<double> step(q);
    for (std::size_t j = 0; j < q; ++j)
      for (std::size_t k = 0; k < q; ++k) step[j] += P_[j * q + k] * B_[k][i];
    return step;
  }

  std::span<const double> e_;
  std::vector<std::span<const double>> B_;
  std::vector<double> c_, P_;  // P: the inverse of B^T B of the others
  double squares_;
};

}  // namespace rolling
