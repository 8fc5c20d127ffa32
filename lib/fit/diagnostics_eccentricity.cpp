// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/diagnostics.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/matrix.h"
#include "base/median.h"
#include "contact/contact.h"
#include "statistics/levels.h"
#include "least_squares/triangles.h"

namespace rolling {
namespace {

/// The response of the raw column to dD = cos(x/r) and to dD = sin(x/r) [m] at the time t, as far
/// as the speed hardly changes in a turn: the acceleration -rate dD integrated once or twice over
/// x = v t.
std::array<double, 2> response(const ObservedRun& run, Roll& roll, double r, double t) {
  constexpr double slow = 0.15;  // of v0: below it a body makes hardly a part of a turn
  const auto p = roll.at(t);
  const double rate = run.body.g * incline(run.body).cos / ((run.body.K + 1) * run.body.R),
               time = r / std::max(std::abs(p.v), slow * roll.at(0).v), cos = std::cos(p.x / r),
               sin = std::sin(p.x / r);
  if (run.column == RawColumn::x)
    return {run.way * rate * time * time * cos, run.way * rate * time * time * sin};
  return {-run.way * rate * time * sin, run.way * rate * time * cos};
}

/// True if a run of so many residuals shows a turn: its roll has one, and two rows in each.
bool shows_a_turn(const ObservedRun& run, Roll roll, std::size_t n) {
  const double turn = 2 * std::numbers::pi * run.body.R;
  const auto first = roll.at(0), last = roll.at(run.t.back());
  double longest = 0;
  for (std::size_t i = 1; i < run.t.size(); ++i)
    longest = std::max(longest, run.t[i] - run.t[i - 1]);
  return n >= 30 && last.x >= turn && 2 * std::max(first.v, last.v) * longest < turn;
}

/// The amplitude of this response in the residuals f of a run, of so many degrees of freedom, and
/// its p.
Eccentricity amplitude(const Fitted& fit, std::size_t run, Roll roll, double r, double freedom,
                       std::span<const double> f) {
  const std::size_t own = fit.system.columns(), q = own + 2;
  Triangles all(1, q, 0);  // of J with the two columns of the response behind it
  const RawModel model = fit.model->raw(fit.minimum.theta, run);
  const RawModel with_response = [&](double t, double* slopes, std::size_t stride) {
    const auto by_e = response(fit.model->runs()[run], roll, r, t);
    for (std::size_t k = 0; k < 2; ++k) slopes[(own + k) * stride] = by_e[k];
    return model(t, slopes, stride);
  };
  const TakeRows take = [&](std::size_t, std::span<double> of_rows, std::span<double> J) {
    std::ranges::copy(f, of_rows.begin());
    all.add(0, of_rows, J);
  };
  evaluate(fit.model->runs()[run], run, q, *fit.noise, with_response, take);
  if (!(all.smallest_sine() > 1e-6)) return {run, 1, 0, 0, 0};
  const std::vector<double> theta = all.solve();
  const double by_cos = theta[own], by_sin = theta[own + 1], e = std::hypot(by_cos, by_sin),
               reduction = all.reduction(own), left = freedom - 2,
               variance = (dot(f, f) - reduction) / left;
  std::vector<double> gradient(q);  // of e
  gradient[own] = by_cos / e, gradient[own + 1] = by_sin / e;
  all.solve_transposed(0, gradient);
  return {run, gsl_cdf_fdist_Q(reduction / variance / 2, 2, left), e,
          std::sqrt(variance * dot(gradient, gradient)), std::atan2(by_sin, by_cos)};
}

/// Cuts residuals off at a few standard deviations: a burst or a lost echo has all periods.
void cut_off(std::span<double> f) {
  const double most = levels::cut_off * deviation({f.begin(), f.end()});
  if (!(most > 0)) return;
  for (double& x : f) x = std::clamp(x, -most, most);
}

}  // namespace

std::optional<Eccentricity> eccentricity_of(const Fitted& fit) {
  if (!fit.is_roll() || fit.minimum.f.size() < fit.minimum.theta.size() + 10) return {};
  std::optional<Eccentricity> found;
  std::vector<double> f = fit.minimum.f;
  const auto f_of = by_run(f, fit.system.runs);
  for (std::size_t r = 0; r < f_of.size(); ++r) {
    cut_off(f_of[r]);
    const double freedom =
        static_cast<double>(f_of[r].size()) - static_cast<double>(fit.system.columns());
    if (!(freedom > 2 && dot(f_of[r], f_of[r]) > 0)) continue;
    const ObservedRun& run = fit.model->runs()[r];
    const Roll roll = fit.model->roll(fit.minimum.theta, r);
    if (!shows_a_turn(run, roll, f_of[r].size())) continue;
    const auto signal = [&](double stretch) {
      return amplitude(fit, r, roll, stretch * run.body.R, freedom, f_of[r]);
    };
    Eccentricity once_a_turn = signal(1);
    once_a_turn.p *= static_cast<double>(f_of.size());
    if (once_a_turn.p > levels::one_turn || (found && found->p < once_a_turn.p)) continue;
    if (once_a_turn.p < std::min(signal(0.7).p, signal(1.4).p)) found = once_a_turn;
  }
  return found;
}

}  // namespace rolling
