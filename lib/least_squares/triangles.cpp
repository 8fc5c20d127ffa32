// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_squares/triangles.h"

#include "base/matrix.h"

#include <algorithm>
#include <cmath>

namespace rolling {
namespace {

/// Updates the triangle R (q columns of J and one of f, row by row) with m further rows of [J f],
/// given column by column, the columns of J `stride` apart, by Householder reflections: R becomes
/// the triangle of [R; J f]. Columns of zeros cost nothing.
void fold(double* R, std::size_t q, double* J, double* f, std::size_t m, std::size_t stride) {
  for (std::size_t j = 0; j < q; ++j) {
    const double* const x = J + j * stride;
    const double below = dot(x, x, m);
    if (below == 0) continue;
    double* const row = R + j * (q + 1);
    const double length = -std::copysign(std::sqrt(row[j] * row[j] + below), row[j]);
    const double head = row[j] - length;
    row[j] = length;
    for (std::size_t k = j + 1; k <= q; ++k) {
      double* const y = k < q ? J + k * stride : f;
      const double w = (head * row[k] + dot(x, y, m)) / (length * head);
      row[k] += w * head;
      if (w != 0)
        for (std::size_t i = 0; i < m; ++i) y[i] += w * x[i];
    }
  }
}

}  // namespace

void Triangles::add(std::size_t run, std::span<double> f, std::span<double> J) {
  constexpr std::size_t block = 256;  // stays in the cache for all columns
  for (std::size_t i = 0; i < f.size(); i += block)
    fold(of(run), q(), J.data() + i, &f[i], std::min(block, f.size() - i), f.size());
}

void Triangles::join() {
  std::vector<double> common(shared_ * (shared_ + 1));
  std::vector<double> J(shared_ * shared_);
  std::vector<double> f(shared_);
  for (std::size_t r = 0; r < runs_; ++r) {
    for (std::size_t i = 0; i < shared_; ++i) {
      const double* const row = of(r) + (own_ + i) * (q() + 1) + own_;
      for (std::size_t j = 0; j < shared_; ++j) J[j * shared_ + i] = row[j];
      f[i] = row[shared_];
    }
    fold(common.data(), shared_, J.data(), f.data(), shared_, shared_);
  }
  for (std::size_t r = 0; r < runs_; ++r)
    for (std::size_t i = 0; i < shared_; ++i)
      std::copy_n(&common[i * (shared_ + 1)], shared_ + 1, of(r) + (own_ + i) * (q() + 1) + own_);
}

Triangles Triangles::damped(const std::vector<double>& D, double mu) const {
  Triangles all = *this;
  for (std::size_t r = 0; r < runs_; ++r) {
    // The first run alone keeps the shared rows, which the others have too.
    if (r > 0) std::fill(all.of(r) + own_ * (q() + 1), all.of(r) + triangle(), 0.0);
    const std::size_t count = r > 0 ? own_ : q();
    std::vector<double> J(count * q());
    std::vector<double> f(count);
    for (std::size_t i = 0; i < count; ++i) J[i * count + i] = std::sqrt(mu) * D[place(r, i)];
    all.add(r, f, J);
  }
  all.join();
  return all;
}

/// Calls row(run, j, elements) for each row of the triangle of the whole problem, the shared rows
/// once.
template <typename Row>
void Triangles::rows(Row&& row) const {
  for (std::size_t r = 0; r < runs_; ++r)
    for (std::size_t j = 0; j < (r ? own_ : q()); ++j) row(r, j, of(r) + j * (q() + 1));
}

std::vector<double> Triangles::solve() const {
  std::vector<double> theta(runs_ * own_ + shared_);
  for (std::size_t r = 0; r < runs_; ++r)
    for (std::size_t j = q(); j-- > 0;) {
      const double* const row = of(r) + j * (q() + 1);
      double sum = -row[q()];
      for (std::size_t k = j + 1; k < q(); ++k) sum -= row[k] * theta[place(r, k)];
      theta[place(r, j)] = sum / row[j];
    }
  return theta;
}

void Triangles::solve_transposed(std::size_t run, std::span<double> g) const {
  const double* row = of(run);
  for (std::size_t j = 0; j < q(); ++j, row += q() + 1) {
    g[j] /= row[j];
    for (std::size_t k = j + 1; k < q(); ++k) g[k] -= row[k] * g[j];
  }
}

std::vector<double> Triangles::step_that_changes(std::vector<double> g, double value) const {
  solve_transposed(0, g);
  const double unit = value / dot(g, g);
  Triangles along = *this;
  for (std::size_t r = 0; r < runs_; ++r)
    for (std::size_t j = 0; j < q(); ++j)
      along.of(r)[j * (q() + 1) + q()] = r > 0 && j < own_ ? 0 : -unit * g[j];
  return along.solve();
}

double Triangles::reduction(std::size_t from) const {
  double sum = 0;
  rows([&](std::size_t, std::size_t j, const double* row) {
    if (j >= from) sum += row[q()] * row[q()];
  });
  return sum;
}

std::vector<double> Triangles::lengths() const {
  std::vector<double> all(runs_ * own_ + shared_);
  rows([&](std::size_t r, std::size_t j, const double* row) {
    for (std::size_t k = j; k < q(); ++k) all[place(r, k)] = std::hypot(all[place(r, k)], row[k]);
  });
  return all;
}

double Triangles::smallest_sine() const {
  const std::vector<double> all = lengths();
  double smallest = 1;
  rows([&](std::size_t r, std::size_t j, const double* row) {
    const double length = all[place(r, j)];
    smallest = std::min(smallest, length > 0 ? std::abs(row[j]) / length : 0);
  });
  return smallest;
}

double Triangles::log_determinant() const {
  double sum = 0;
  rows([&](std::size_t, std::size_t j, const double* row) { sum += std::log(std::abs(row[j])); });
  return sum;
}

}  // namespace rolling
