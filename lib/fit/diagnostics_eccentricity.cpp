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

/// The response of the raw column to an eccentricity of one metre, to first order: to dD = cos(x/r)
/// and to dD = sin(x/r). The law is autonomous, so that v'(t) solves the linearised equation of
/// motion. Variation of the constant gives dv = v' w with w' = -(g cos theta/((K + 1) R)) dD / v'.
class Wobble {
 public:
  Wobble(const ObservedRun& run, Roll roll, double r)
      : run_(run), roll_(std::move(roll)), v0_(roll_.at(0).v), r_(r) {}

  /// The response at time t, which must not be before that of the last call: by linear
  /// interpolation in a step.
  std::array<double, 2> at(double t) {
    while (t_ < t) step();
    const double share = t > from_ ? (t - from_) / (t_ - from_) : 0;
    return {std::lerp(before_[0], now_[0], share), std::lerp(before_[1], now_[1], share)};
  }

 private:
  void step() {
    constexpr double longest = 0.1, shares = 512;  // of a step: angle of the body [rad], and part
    constexpr double slow = 0.05;  // share of v0 below which w is constant: it diverges at the stop
    const double by_D = -run_.body.g * incline(run_.body).cos / ((run_.body.K + 1) * run_.body.R),
                 h = std::min(run_.t.back() / shares, longest * r_ / std::abs(roll_.at(t_).v));
    const auto s = roll_.at(t_ + h / 2);
    const double by_force = s.v > slow * v0_ ? by_D / s.a * h / 2 : 0;
    before_ = now_, from_ = t_, t_ += h;
    const double a = roll_.at(t_).a;
    for (std::size_t k = 0; k < 2; ++k) {
      const double half_w = by_force * (k ? std::sin(s.x / r_) : std::cos(s.x / r_));
      dx_[k] += s.a * (w_[k] + half_w) * h;
      w_[k] += 2 * half_w;
      now_[k] = run_.way * (run_.column == RawColumn::x ? dx_[k] : a * w_[k]);
    }
  }

  const ObservedRun& run_;
  Roll roll_;
  double v0_, r_, from_ = 0, t_ = 0;
  std::array<double, 2> w_{}, dx_{}, before_{}, now_{};
};

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
Eccentricity amplitude(const Fitted& fit, std::size_t run, Wobble wobble, double freedom,
                       std::span<const double> f) {
  const std::size_t own = fit.system.columns(), q = own + 2;
  Triangles all(1, q, 0);  // of J with the two columns of the response behind it
  const RawModel model = fit.model->raw(fit.minimum.theta, run);
  const RawModel with_wobble = [&](double t, double* slopes, std::size_t stride) {
    const auto by_e = wobble.at(t);
    for (std::size_t k = 0; k < 2; ++k) slopes[(own + k) * stride] = by_e[k];
    return model(t, slopes, stride);
  };
  const TakeRows take = [&](std::size_t, std::span<double> of_rows, std::span<double> J) {
    std::ranges::copy(f, of_rows.begin());
    all.add(0, of_rows, J);
  };
  evaluate(fit.model->runs()[run], run, q, *fit.noise, with_wobble, take);
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
      return amplitude(fit, r, Wobble(run, roll, stretch * run.body.R), freedom, f_of[r]);
    };
    Eccentricity once_a_turn = signal(1);
    once_a_turn.p *= static_cast<double>(f_of.size());
    if (once_a_turn.p > levels::one_turn || (found && found->p < once_a_turn.p)) continue;
    if (once_a_turn.p < std::min(signal(0.7).p, signal(1.4).p)) found = once_a_turn;
  }
  return found;
}

}  // namespace rolling
