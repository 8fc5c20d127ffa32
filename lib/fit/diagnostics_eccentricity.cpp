// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/diagnostics.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/chebyshev.h"
#include "base/matrix.h"
#include "base/median.h"
#include "contact/contact.h"
#include "statistics/levels.h"
#include "least_squares/triangles.h"

namespace rolling {
namespace {

/// True if a run of so many residuals shows a turn: its roll has one, and two rows in each.
bool shows_a_turn(const ObservedRun& run, const Path& path, std::size_t n) {
  const double turn = 2 * std::numbers::pi * run.body.R;
  double longest = 0;
  for (std::size_t i = 1; i < run.t.size(); ++i)
    longest = std::max(longest, run.t[i] - run.t[i - 1]);
  return n >= 30 && path.back()[0] >= turn &&
         2 * std::max(path.front()[1], path.back()[1]) * longest < turn;
}

/// The response of the raw column to dD = cos(x/r), and behind it that to dD = sin(x/r) [m], as far
/// as the speed hardly changes in a turn: the acceleration -rate dD integrated once or twice over
/// x = v t.
std::vector<double> response(const ObservedRun& run, const Path& path, double r) {
  constexpr double slow = 0.15;  // of v0: below it a body makes hardly a part of a turn
  const double rate = run.body.g * incline(run.body).cos / ((run.body.K + 1) * run.body.R);
  const std::size_t n = path.size();
  std::vector<double> columns(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto [x, v] = path[i];
    const double time = r / std::max(std::abs(v), slow * path[0][1]);
    const double by_v = run.way * rate * time;
    const double cos = by_v * std::cos(x / r);
    const double sin = by_v * std::sin(x / r);
    const bool position = run.column == Quantity::x;
    columns[i] = position ? time * cos : -sin;
    columns[n + i] = position ? time * sin : cos;
  }
  return columns;
}

/// The columns Q that the fit follows, and behind them those of the response as the residuals see
/// it.
std::vector<double> columns_beside(std::span<const std::span<const double>> Q, const Fitted& fit,
                                   std::size_t run, std::vector<double> by_e) {
  const ObservedRun& of = fit.model.runs()[run];
  if (of.H) by_e = of.H->times(by_e);
  if (fit.noise().known()) fit.noise().whitener(run).apply(by_e);
  std::vector<double> columns;
  columns.reserve(Q.size() * of.t.size() + by_e.size());
  for (const auto column : Q) columns.insert(columns.end(), column.begin(), column.end());
  columns.insert(columns.end(), by_e.begin(), by_e.end());
  return columns;
}

/// The amplitude of the response to a period of 2 pi r in the residuals f of a run, of so many
/// degrees of freedom, and its p.
Eccentricity amplitude(const Fitted& fit, std::size_t run, const Path& path, double r,
                       double freedom, std::vector<double> f,
                       std::span<const std::span<const double>> Q) {
  const std::size_t own = Q.size();
  const std::size_t q = own + 2;
  std::vector<double> columns =
      columns_beside(Q, fit, run, response(fit.model.runs()[run], path, r));
  const double squares = dot(f, f);
  const double left = freedom - 2;
  Triangles all(1, q, 0);
  all.add(0, f, columns);
  if (!(all.smallest_sine() > 1e-6)) return {run, 1, 0, 0, 0};
  const std::vector<double> theta = all.solve();
  const double by_cos = theta[own];
  const double by_sin = theta[own + 1];
  const double e = std::hypot(by_cos, by_sin);
  const double reduction = all.reduction(own);
  const double variance = (squares - reduction) / left;
  std::vector<double> gradient(q);  // of e
  gradient[own] = by_cos / e;
  gradient[own + 1] = by_sin / e;
  all.solve_transposed(0, gradient);
  return {run, gsl_cdf_fdist_Q(reduction / variance / 2, 2, left), e,
          std::sqrt(variance * dot(gradient, gradient)), std::atan2(by_sin, by_cos)};
}

/// True if the signal of one turn is that of the whole roll: a body is out of balance all along its
/// way. What a hand or a filter leaves in the residuals differs from third to third of the way.
/// What the response leaves out of a strong signal differs, too, but by little of it.
bool is_all_along(const Fitted& fit, std::size_t run, const Path& path, double freedom,
                  std::vector<double> f, std::span<const std::span<const double>> Q) {
  const ObservedRun& of = fit.model.runs()[run];
  std::vector<double> by_e = response(of, path, of.body.R);
  const std::size_t n = path.size();
  for (const double third : {1., 2.}) {
    const double from = third / 3 * path.back()[0];
    for (std::size_t i = 0; i < 2 * n; ++i) by_e.push_back(path[i % n][0] < from ? 0 : by_e[i]);
  }
  const std::size_t own = Q.size();
  std::vector<double> columns = columns_beside(Q, fit, run, std::move(by_e));
  Triangles all(1, own + 6, 0);
  const double squares = dot(f, f);
  all.add(0, f, columns);
  const double left = freedom - 6;
  if (!(left > 0 && all.smallest_sine() > 1e-6)) return true;
  const double variance = (squares - all.reduction(own)) / left;
  const double differ = all.reduction(own + 2);
  return differ < levels::of_common * (all.reduction(own) - differ) ||
         gsl_cdf_fdist_Q(differ / variance / 4, 4, left) > levels::thirds;
}

/// Cuts residuals off at a few standard deviations: a burst or a lost echo has all periods.
std::vector<double> cut_off(std::span<const double> f) {
  const double most = levels::cut_off * deviation({f.begin(), f.end()});
  std::vector<double> cut(f.begin(), f.end());
  for (double& x : cut)
    if (most > 0) x = std::clamp(x, -most, most);
  return cut;
}

}  // namespace

Path path_of(const Fitted& fit, std::size_t r) {
  const ObservedRun& run = fit.model.runs()[r];
  Roll roll = fit.roll(r);
  const double last = run.t.back();
  ChebyshevPanels at(run.t, {roll.stop_until(last), roll.radius_time(last)}, [&](double t) {
    const Roll::Point p = roll.at(t);
    return std::array{p.x, p.v};
  });
  Path path;
  for (const double t : run.t) path.push_back(at(t));
  return path;
}

std::optional<Eccentricity> eccentricity_of(const Fitted& fit, const Matrix& Q) {
  if (!fit.is_roll() || fit.minimum.f.size() < fit.minimum.theta.size() + 10) return {};
  std::optional<Eccentricity> found;
  const std::vector<std::size_t> rows = fit.model.rows();
  const auto f_of = by_run(fit.minimum.f, rows);
  const auto Q_of = rows_by_run(Q, rows);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const std::vector<double> f = cut_off(f_of[r]);
    const double freedom = static_cast<double>(rows[r]) - static_cast<double>(Q.size());
    if (!(freedom > 2 && dot(f, f) > 0)) continue;
    const ObservedRun& run = fit.model.runs()[r];
    const Path path = path_of(fit, r);
    if (!shows_a_turn(run, path, f.size())) continue;
    const auto signal = [&](double stretch) {
      return amplitude(fit, r, path, stretch * run.body.R, freedom, f, Q_of[r]);
    };
    Eccentricity once_a_turn = signal(1);
    once_a_turn.p *= static_cast<double>(rows.size());
    if (once_a_turn.p > levels::one_turn || (found && found->p < once_a_turn.p)) continue;
    if (once_a_turn.p < std::min(signal(0.7).p, signal(1.4).p) &&
        is_all_along(fit, r, path, freedom, f, Q_of[r]))
      found = once_a_turn;
  }
  return found;
}

}  // namespace rolling
