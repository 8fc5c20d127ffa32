// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/diagnostics.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>

#include "base/matrix.h"
#include "statistics/levels.h"
#include "statistics/residuals.h"

namespace rolling {
namespace {

bool fits_positions(const Fitted& fit) {
  return fit.is_roll() && !fit.noise().known() && fit.model.runs().front().column == Quantity::x;
}

/// The velocities of the roll at the rows of a run.
std::vector<double> velocities(const Fitted& fit, std::size_t run) {
  std::vector<double> v;
  for (const auto& [x, speed] : path_of(fit, run)) v.push_back(fit.model.runs()[run].way * speed);
  return v;
}

/// A jump before one row. Its column is the velocity from there on, less what the fit can follow.
struct Jump {
  std::size_t row = 0;
  double by = 0;                                                ///< [s]
  double length = 0;                                            ///< of the column
  double squares() const { return by * by * length * length; }  ///< what it takes from those of f
};

/// The jump that takes most from the squares of f. Q: what the fit can follow. The products of the
/// velocity from a row on with other columns are sums that begin at the last row.
Jump largest_jump(std::span<const double> f, const std::vector<double>& v,
                  const std::vector<std::span<const double>>& Q) {
  constexpr std::size_t beside = 3;  // rows on either side
  Jump most;
  std::vector<double> with_Q(Q.size());
  double with_f = 0;
  double with_v = 0;
  for (std::size_t i = f.size(); i-- > beside;) {
    with_f += v[i] * f[i];
    with_v += v[i] * v[i];
    for (std::size_t k = 0; k < Q.size(); ++k) with_Q[k] += v[i] * Q[k][i];
    const double left = with_v - dot(with_Q, with_Q);
    if (i + beside > f.size() || !(left > 1e-6 * with_v)) continue;
    const Jump jump{i, -with_f / left, std::sqrt(left)};  // f is model - reading
    if (jump.squares() > most.squares()) most = jump;
  }
  return most;
}

/// The column of a jump.
std::vector<double> column_of(const Jump& jump, const std::vector<double>& v,
                              const std::vector<std::span<const double>>& Q) {
  const auto row = static_cast<std::ptrdiff_t>(jump.row);
  std::vector<double> whole(v.size());
  std::copy(v.begin() + row, v.end(), whole.begin() + row);
  std::vector<double> column = whole;
  for (const auto q : Q) {
    const double part = dot(whole, q);
    for (std::size_t i = 0; i < column.size(); ++i) column[i] -= part * q[i];
  }
  return column;
}

}  // namespace

std::optional<ClockJump> jump_of_clock(const Fitted& fit, const Matrix& Q_of_fit) {
  constexpr std::size_t most = 5;
  if (!fits_positions(fit) || fit.model.runs().size() > 1) return {};
  const ObservedRun& run = fit.model.runs().front();
  const std::vector<double> v = velocities(fit, 0);
  std::vector<std::span<const double>> Q(Q_of_fit.begin(), Q_of_fit.end());
  const double step = run.t.back() / static_cast<double>(run.t.size() - 1);
  std::vector<double> f = fit.minimum.f;
  Matrix columns;
  columns.reserve(most);  // Q refers to them
  std::optional<ClockJump> found;
  while (columns.size() < most && f.size() > Q.size() + 10) {
    const Jump jump = largest_jump(f, v, Q);
    const double freedom = static_cast<double>(f.size() - Q.size() - 1);
    const double rest = dot(f, f) - jump.squares();
    const double p = gsl_cdf_fdist_Q(jump.squares() / rest * freedom, 1, freedom) *
                     static_cast<double>(f.size());
    if (!(p <= levels::clock_jump)) break;
    // A frame is one step. A hand at the begin of a roll seems to make less.
    if (!found && std::abs(jump.by) < step / 2) break;
    if (!found) found = {run.origin + run.t[jump.row], jump.by, p};
    std::vector<double>& column = columns.emplace_back(column_of(jump, v, Q));
    for (std::size_t i = 0; i < f.size(); ++i) {
      f[i] += jump.by * column[i];
      column[i] /= jump.length;
    }
    Q.emplace_back(column);
  }
  const std::size_t runs[] = {f.size()};
  if (found && ljung_box(f, taken_by_few(Q.size()), runs) <= levels::not_white) return {};
  return found;
}

double noise_of_clock(const Fitted& fit) {
  if (!fits_positions(fit)) return 0;
  const std::vector<std::size_t> rows = fit.model.rows();
  const std::vector<double>& f = fit.minimum.f;
  std::vector<double> of_f;  // squares
  std::vector<double> of_v;
  for (const double x : f) of_f.push_back(x * x);
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (const double v : velocities(fit, r)) of_v.push_back(v * v);
  // The variance of f is a + b v^2. The variance of f^2 is twice the square of that.
  std::vector<double> weight(f.size(), 1);
  std::vector<double> even(f.size());
  double a = 0;
  double b = 0;
  for (int round = 0; round < 5; ++round) {
    double aa;
    double ab;
    double bb;
    double chi2;
    gsl_fit_wlinear(of_v.data(), 1, weight.data(), 1, of_f.data(), 1, f.size(), &a, &b, &aa, &ab,
                    &bb, &chi2);
    if (!(b > 0)) return 0;
    a = std::max(a, 1e-3 * dot(f, f) / static_cast<double>(f.size()));
    for (std::size_t i = 0; i < f.size(); ++i) {
      const double variance = a + b * of_v[i];
      weight[i] = 1 / (variance * variance);
      even[i] = f[i] / std::sqrt(variance);
    }
  }
  return breusch_pagan(even, rows) > levels::uneven ? std::sqrt(b) : 0;
}

}  // namespace rolling
