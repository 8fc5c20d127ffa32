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
#include "fit/levels.h"
#include "least_squares/triangles.h"

namespace rolling {
namespace {

double square(double x) { return x * x; }

/// The response of the raw column to an eccentricity of one metre, to first order: to dD = cos(x/r)
/// and to dD = sin(x/r). The law is autonomous, so that v'(t) solves the linearised equation of
/// motion. Variation of the constant gives dv = v' w with w' = -(g cos theta/((K + 1) R)) dD / v'.
class Wobble {
 public:
  Wobble(const ObservedRun& run, Roll roll, double r) {
    constexpr double longest = 0.1, shares = 512;  // of a step: angle of the body [rad], and part
    constexpr double slow = 0.05;  // share of v0 below which w is constant: it diverges at the stop
    const double by_D = -run.body.g * incline(run.body).cos / ((run.body.K + 1) * run.body.R),
                 v0 = roll.at(0).v, last = run.t.back();
    std::array<double, 2> w{}, dx{}, dv{};
    for (double t = 0, h = 0; t < last; t += h) {
      const double speed = std::abs(roll.at(t).v);
      h = std::min(last / shares, last - t);
      if (speed * h > longest * r) h = longest * r / speed;
      const auto s = roll.at(t + h / 2);
      fastest_ = std::max(fastest_, s.v), way_ = s.x;
      const double by_force = s.v > slow * v0 ? by_D / s.a * h / 2 : 0;
      for (std::size_t k = 0; k < 2; ++k) {
        const double half_w = by_force * (k ? std::sin(s.x / r) : std::cos(s.x / r));
        dv[k] = s.a * (w[k] + half_w);
        dx[k] += dv[k] * h;
        w[k] += 2 * half_w;
      }
      const auto& raw = run.column == RawColumn::x ? dx : dv;
      t_.push_back(run.column == RawColumn::x ? t + h : t + h / 2);
      of_t_.push_back({run.way * raw[0], run.way * raw[1]});
    }
  }

  /// The response at time t, by linear interpolation.
  std::array<double, 2> at(double t) const {
    const auto i = static_cast<std::size_t>(std::ranges::upper_bound(t_, t) - t_.begin());
    if (i == t_.size()) return of_t_.back();
    const double before = i ? t_[i - 1] : 0, share = (t - before) / (t_[i] - before);
    const auto between = [&](std::size_t k) {
      const double from = i ? of_t_[i - 1][k] : 0;
      return from + share * (of_t_[i][k] - from);
    };
    return {between(0), between(1)};
  }

  /// True if a run of so many residuals shows a turn of R: it has one, and two rows in each.
  bool worth(const ObservedRun& run, std::size_t n, double R) const {
    double longest = 0;
    for (std::size_t i = 1; i < run.t.size(); ++i)
      longest = std::max(longest, run.t[i] - run.t[i - 1]);
    return n >= 30 && way_ >= 2 * std::numbers::pi * R && fastest_ * longest < std::numbers::pi * R;
  }

 private:
  std::vector<double> t_;
  std::vector<std::array<double, 2>> of_t_;
  double fastest_ = 0, way_ = 0;
};

/// The amplitude of this response in the residuals f of a run, of so many degrees of freedom, and
/// its p.
Eccentricity amplitude(const Fitted& fit, std::size_t run, const Wobble& wobble, double freedom,
                       std::span<const double> f) {
  // The QR decomposition of J with the two columns of the response behind it: the last 2 x 2 block
  // of R belongs to these columns after projection orthogonal to J, and theta holds their
  // coefficients.
  const std::size_t own = fit.system.columns(), q = own + 2;
  Triangles all(1, 0, q);
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
  all.join();
  const std::vector<double> R = all.without_f(), theta = all.solve();
  const double cc = R[(q - 2) * q + q - 2], cs = R[(q - 2) * q + q - 1], ss = R[q * q - 1],
               by_cos = theta[q - 2], by_sin = theta[q - 1];
  if (!(ss * ss > 1e-12 * (cs * cs + ss * ss))) return {run, 1, 0, 0, 0};
  const double reduction = square(cc * by_cos + cs * by_sin) + square(ss * by_sin),
               e = std::hypot(by_cos, by_sin), left = freedom - 2,
               variance = (dot(f, f) - reduction) / left;
  // The standard error of e is the norm of R^-T (by_cos, by_sin)/e times the standard deviation.
  const double u = by_cos / (e * cc), w = (by_sin / e - u * cs) / ss;
  return {run, gsl_cdf_fdist_Q(reduction / variance / 2, 2, left), e,
          std::sqrt(variance * (u * u + w * w)), std::atan2(by_sin, by_cos)};
}

/// Cuts residuals off at a few standard deviations: a burst or a lost echo has all periods.
void cut_off(std::span<double> f) {
  std::vector<double> sizes(f.begin(), f.end());
  for (double& x : sizes) x = std::abs(x);
  const double most = levels::cut_off * deviation(sizes);
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
    const auto signal = [&](const Wobble& wobble) {
      return amplitude(fit, r, wobble, freedom, f_of[r]);
    };
    const ObservedRun& run = fit.model->runs()[r];
    const double R = run.body.R;
    const auto wobble = [&](double stretch) {
      return Wobble(run, fit.model->roll(fit.minimum.theta, r), stretch * R);
    };
    const Wobble turns = wobble(1);
    if (!turns.worth(run, f_of[r].size(), R)) continue;
    Eccentricity once_a_turn = signal(turns);
    once_a_turn.p *= static_cast<double>(f_of.size());
    if (once_a_turn.p > levels::one_turn || (found && found->p < once_a_turn.p)) continue;
    if (once_a_turn.p < std::min(signal(wobble(0.7)).p, signal(wobble(1.4)).p)) found = once_a_turn;
  }
  return found;
}

}  // namespace rolling
