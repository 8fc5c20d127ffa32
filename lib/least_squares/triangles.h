// SPDX-License-Identifier: GPL-3.0-or-later
// The QR decomposition of a Jacobian of several runs that share some of their parameters.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rolling {

/// The upper triangular factors R of [J f] = Q R, one for the columns of each run (its own
/// parameters, then the shared ones, then f). Block elimination: the rows of each R that concern
/// the shared parameters alone are combined into one common block, so that the work grows linearly
/// with the number of runs.
class Triangles {
 public:
  Triangles() = default;
  /// `own` parameters of each run, `shared` ones of all (see System).
  Triangles(std::size_t runs, std::size_t own, std::size_t shared)
      : runs_(runs), own_(own), shared_(shared), R_(runs_ * triangle()) {}
  /// Updates the triangle of a run with further rows by Householder reflections; overwrites f and
  /// J.
  void add(std::size_t run, std::span<double> f, std::span<double> J);
  /// Combines the shared blocks of all triangles into one; call it after the last row.
  void join();
  /// The triangles of [J; sqrt(mu) D] and [f; 0], D diagonal: those of a Levenberg-Marquardt step.
  Triangles damped(const std::vector<double>& D, double mu) const;

  /// The theta that minimises |J theta + f|.
  std::vector<double> solve() const;
  /// Replaces g by R^-T g for the columns of one run.
  void solve_transposed(std::size_t run, std::span<double> g) const;
  /// The theta of least |J theta| at which the linear number with this gradient, by the columns of
  /// the first run, has this value.
  std::vector<double> step_that_changes(std::vector<double> gradient, double value) const;
  /// The reduction of the sum of squares from theta = 0 to that minimum; of a single run, by the
  /// columns from this one on alone, beside those before them.
  double reduction(std::size_t from = 0) const;
  /// The norms of the columns of J.
  std::vector<double> lengths() const;
  /// The smallest sine of the angle between a column of J and the span of the columns before it; 0
  /// if J is rank-deficient.
  double smallest_sine() const;
  /// ln |det R|.
  double log_determinant() const;

 private:
  template <typename Row>
  void rows(Row&& row) const;
  std::size_t q() const { return own_ + shared_; }
  std::size_t place(std::size_t run, std::size_t column) const {
    return column < own_ ? run * own_ + column : (runs_ - 1) * own_ + column;
  }
  std::size_t triangle() const { return q() * (q() + 1); }
  double* of(std::size_t run) { return R_.data() + run * triangle(); }
  const double* of(std::size_t run) const { return R_.data() + run * triangle(); }

  std::size_t runs_ = 0, own_ = 0, shared_ = 0;
  std::vector<double> R_;  // triangles of all runs, row by row, f last in each row
};

}  // namespace rolling
