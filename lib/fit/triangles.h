// The QR decomposition of the Jacobian of several runs that share some of their parameters.
#pragma once

#include "fit/system.h"

namespace rolling {

/// The upper triangles R of [J f] = Q R, one for the columns of each run. What is left of a run
/// beside its own parameters is folded together with that of the others (block elimination), so
/// that the work grows linearly with the number of runs.
class Triangles {
 public:
  explicit Triangles(const System&);
  /// Folds rows of a run into its triangle by Householder reflections; overwrites them.
  void add(std::size_t run, std::span<double> f, std::span<double> J);
  /// To be called after the last row: makes the shared part the same in all triangles.
  void join() { join(std::vector<double>(shared_ * (shared_ + 1))); }
  /// The triangles of J with sqrt(mu) D below it, D diagonal, and of f with 0 below it.
  Triangles damped(const std::vector<double>& D, double mu) const;

  /// The theta that makes |J theta + f| smallest.
  std::vector<double> solve() const;
  /// By how much the sum of squares at that theta is smaller than at 0.
  double reduction() const;
  /// The norms of the columns of J.
  std::vector<double> lengths() const;
  /// The smallest sine between a column of J and the columns before it.
  double smallest_sine() const;
  /// ln |det R|.
  double log_determinant() const;
  /// R without the column of f: an upper triangle for each run, row by row, one after another.
  std::vector<double> without_f() const;

 private:
  void join(std::vector<double> common);
  template <typename Row>
  void rows(Row&& row) const;
  std::size_t q() const { return own_ + shared_; }
  std::size_t place(std::size_t run, std::size_t column) const {
    return column < own_ ? run * own_ + column : (runs_ - 1) * own_ + column;
  }
  std::size_t triangle() const { return q() * (q() + 1); }
  double* of(std::size_t run) { return R_.data() + run * triangle(); }
  const double* of(std::size_t run) const { return R_.data() + run * triangle(); }

  std::size_t runs_, own_, shared_;
  std::vector<double> R_;  // row by row, f last in each row
};

}  // namespace rolling
