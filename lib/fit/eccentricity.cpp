// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/eccentricity.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/by_run.h"
#include "base/dot.h"
#include "base/median.h"
#include "contact/contact.h"
#include "fit/levels.h"
#include "least_squares/triangles.h"

namespace rolling {
namespace {

using Column = std::vector<double>;

/// The response of the raw column to an eccentricity of one metre, to first order: to dD = cos(x/r)
/// and to dD = sin(x/r). The law is autonomous, so that v'(t) solves the linearised equation of
/// motion. Variation of the constant gives dv = v' w with w' = -(g cos theta/((K + 1) R)) dD / v'.
class Wobble {
 public:
  /// `times` increase.
  Wobble(const ObservedRun& run, Roll roll, std::span<const double> times, double r)
      : t_(times.begin(), times.end()) {
    constexpr double longest = 0.2;  // integration step, angle of the body [rad]
    constexpr double slow = 0.05;  // share of v0 below which w is constant: it diverges at the stop
    const double by_D = -run.body.g * incline(run.body).cos / ((run.body.K + 1) * run.body.R);
    std::array<double, 2> w{}, dx{}, dv{};
    double before = 0;
    for (double t : t_) {
      const double angle = roll.at(before).v * (t - before) / r;
      const double count = std::clamp(std::ceil(angle / longest), 1.0, 32.0),
                   h = (t - before) / count;
      for (double i = 0; h > 0 && i < count; ++i) {
        const auto s = roll.at(before + (i + 0.5) * h);
        if (first_v_ == 0) first_v_ = s.v;
        fastest_ = std::max(fastest_, s.v);
        const double acceleration = s.a,
                     by_force = s.v > slow * first_v_ ? by_D / acceleration * h / 2 : 0;
        for (std::size_t k = 0; k < 2; ++k) {
          const double half_w = by_force * (k ? std::sin(s.x / r) : std::cos(s.x / r));
          dv[k] = acceleration * (w[k] + half_w);
          dx[k] += dv[k] * h;
          w[k] += 2 * half_w;
        }
        way_ = s.x;
      }
      const auto& raw = run.raw_is_position ? dx : dv;
      of_t_.push_back({run.way * raw[0], run.way * raw[1]});
      before = t;
    }
  }

  /// The response at time t, by linear interpolation.
  std::array<double, 2> at(double t) const {
    const auto next = std::lower_bound(t_.begin(), t_.end(), t) - t_.begin();
    const auto i = static_cast<std::size_t>(next);
    if (i == t_.size()) return of_t_.back();
    if (i == 0 || t_[i] == t) return of_t_[i];
    const double share = (t - t_[i - 1]) / (t_[i] - t_[i - 1]);
    const auto between = [&](std::size_t k) {
      return of_t_[i - 1][k] + share * (of_t_[i][k] - of_t_[i - 1][k]);
    };
    return {between(0), between(1)};
  }
  double fastest() const { return fastest_; }
  double way() const { return way_; }

 private:
  Column t_;
  std::vector<std::array<double, 2>> of_t_;
  double first_v_ = 0, fastest_ = 0, way_ = 0;
};

/// The noise of a run: the sum of squares of its residuals, their degrees of freedom, and the
/// variance of the noise before the filters.
struct RunNoise {
  double squares, freedom, variance;
};

/// The periodogram of one run of a fit.
class Periodogram {
 public:
  /// R is the radius of the body, and f the residuals; if the filters are known, f is the noise of
  /// the raw column that explains the residuals. For residuals H e this f is e without what the
  /// filters remove, which of positions is their mean.
  Periodogram(const Fitted& fit, std::size_t run, double R, RunNoise noise,
              std::span<const double> f)
      : fit_(fit), run_(run), R_(R), noise_(noise), f_(f) {
    for (std::size_t end : ends_) times_.push_back(seen_.t[end - 1]);
  }

  /// The response at the period 2 pi R times `stretch`.
  Wobble wobble(double stretch) const { return {seen_, roll_, times_, stretch * R_}; }

  bool worth(const Wobble& wobble) const {
    if (f_.size() < 30 || !(wobble.way() >= 2 * std::numbers::pi * R_)) return false;
    double longest = 0;
    for (std::size_t i = 1; i < seen_.t.size(); ++i)
      longest = std::max(longest, seen_.t[i] - seen_.t[i - 1]);
    return wobble.fastest() * longest < std::numbers::pi * R_;
  }

  /// The amplitude of this response and its p.
  Eccentricity of(const Wobble& wobble) const {
    // The QR decomposition of J with the two columns of the response behind it: the last 2 x 2
    // block of R belongs to these columns after projection orthogonal to J, and theta holds their
    // coefficients.
    const bool mean_removed = fit_.filters_known() && fit_.means_taken() > 0;
    const std::size_t q = q_ + mean_removed + 2;
    Triangles all(1, 0, q);
    fit_.noise->known() && !fit_.filters_known() ? fold_filtered(wobble, all)
                                                 : fold_means(wobble, mean_removed, all);
    all.join();
    const Column R = all.without_f(), theta = all.solve();
    const double cc = R[(q - 2) * q + q - 2], cs = R[(q - 2) * q + q - 1], ss = R[q * q - 1],
                 by_cos = theta[q - 2], by_sin = theta[q - 1];
    if (!(ss * ss > 1e-12 * (cs * cs + ss * ss))) return {run_, 1, 0, 0, 0};
    const double reduction = square(cc * by_cos + cs * by_sin) + square(ss * by_sin),
                 e = std::hypot(by_cos, by_sin), freedom = noise_.freedom - 2,
                 variance =
                     noise_.variance * (1 - reduction / noise_.squares) * noise_.freedom / freedom;
    // The standard error of e is the norm of R^-T (by_cos, by_sin)/e times the standard deviation.
    const double u = by_cos / (e * cc), w = (by_sin / e - u * cs) / ss;
    return {run_, gsl_cdf_fdist_Q(reduction / variance / 2, 2, freedom), e,
            std::sqrt(variance * (u * u + w * w)), std::atan2(by_sin, by_cos)};
  }

 private:
  static double square(double x) { return x * x; }

  /// The ends of blocks of rows that are short relative to one turn and to the run.
  std::vector<std::size_t> thinned() {
    constexpr double turned = 0.1, shares = 512;
    const Column& t = seen_.t;
    std::vector<std::size_t> ends;
    for (auto first = t.begin(); first != t.end();) {
      const double v = roll_.at(*first).v, share = (t.back() - t.front()) / shares,
                   longest = v > 0 ? std::min(share, turned * R_ / v) : share;
      first = std::upper_bound(first, t.end(), *first + longest);
      ends.push_back(static_cast<std::size_t>(first - t.begin()));
    }
    return ends;
  }

  /// For white noise, block means keep the information about everything that varies slowly.
  void fold_means(const Wobble& wobble, bool mean_removed, Triangles& all) const {
    Column J(q_ + mean_removed + 2);
    std::size_t first = 0;
    for (std::size_t end : ends_) {
      const double n = static_cast<double>(end - first);
      double t = 0, f = 0;
      for (; first < end; ++first) t += seen_.t[first] / n, f += f_[first];
      model_(t, J.data(), 1);
      if (mean_removed) J[q_] = 1;
      const auto by_e = wobble.at(t);
      std::copy(by_e.begin(), by_e.end(), J.end() - 2);
      for (double& x : J) x *= std::sqrt(n);
      f /= std::sqrt(n);
      all.add(0, {&f, 1}, J);
    }
  }

  void fold_filtered(const Wobble& wobble, Triangles& all) const {
    const double* f = f_.data();
    const TakeRows take = [&](std::size_t, std::span<double> of_rows, std::span<double> J) {
      std::copy_n(std::exchange(f, f + of_rows.size()), of_rows.size(), of_rows.begin());
      all.add(0, of_rows, J);
    };
    const RawModel with_wobble = [&](double t, double* slopes, std::size_t stride) {
      const auto by_e = wobble.at(t);
      for (std::size_t k = 0; k < 2; ++k) slopes[(q_ + k) * stride] = by_e[k];
      return model_(t, slopes, stride);
    };
    evaluate(seen_, run_, q_ + 2, *fit_.noise, with_wobble, take);
  }

  const Fitted& fit_;
  std::size_t run_, q_ = fit_.system.columns();
  double R_;
  RunNoise noise_;
  std::span<const double> f_;
  const ObservedRun& seen_ = fit_.rolls->runs()[run_];
  Roll roll_ = fit_.rolls->roll(fit_.minimum.theta, run_);
  RawModel model_ = fit_.rolls->raw(fit_.minimum.theta, run_);
  std::vector<std::size_t> ends_ = thinned();
  Column times_;
};

/// Cuts residuals off at a few standard deviations: a burst or a lost echo has all periods. Returns
/// what is left of the sum of their squares, as a share.
double cut_off(std::span<double> f) {
  const double before = dot(f, f);
  Column sizes(f.begin(), f.end());
  for (double& x : sizes) x = std::abs(x);
  const double most = levels::cut_off * deviation(sizes);
  if (!(most > 0)) return 1;
  for (double& x : f) x = std::clamp(x, -most, most);
  return dot(f, f) / before;
}

}  // namespace

std::optional<Eccentricity> eccentricity_of(Route route, const std::vector<FitRun>& runs,
                                            const Fitted& fit, double variance) {
  if (!fit.rolls || fit.minimum.f.size() < fit.minimum.theta.size() + 10) return {};
  std::optional<Eccentricity> found;
  const bool known = fit.filters_known();
  Column f = known ? fit.noise->to_sources(fit.minimum.f) : fit.minimum.f;
  const auto f_of = by_run(f, known ? fit.noise->sources() : fit.system.runs);
  const std::size_t n = fit.minimum.f.size(), p = fit.minimum.theta.size();
  const double of_all = fit.minimum.rss / static_cast<double>(n - p);
  const auto residuals = by_run(fit.minimum.f, fit.system.runs);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const double squares = dot(residuals[r], residuals[r]) * cut_off(f_of[r]),
                 freedom = static_cast<double>(residuals[r].size()) -
                           static_cast<double>(fit.system.columns());
    if (!(freedom > 2 && squares > 0)) continue;
    const RunNoise noise{squares, freedom, variance * (squares / freedom) / of_all};
    const double R = route == Route::shift ? runs[r].shift_of->body.R : runs[r].body.R;
    const Periodogram spectrum(fit, r, R, noise, f_of[r]);
    const Wobble turns = spectrum.wobble(1);
    if (!spectrum.worth(turns)) continue;
    Eccentricity once_a_turn = spectrum.of(turns);
    once_a_turn.p *= static_cast<double>(runs.size());
    if (once_a_turn.p > levels::one_turn || (found && found->p < once_a_turn.p)) continue;
    const double near =
        std::min(spectrum.of(spectrum.wobble(0.7)).p, spectrum.of(spectrum.wobble(1.4)).p);
    if (once_a_turn.p < near) found = once_a_turn;
  }
  return found;
}

}  // namespace rolling
