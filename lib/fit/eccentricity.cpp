#include "fit/eccentricity.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/contact.h"
#include "fit/dot.h"
#include "fit/errors.h"

namespace rolling {
namespace {

using Column = std::vector<double>;

/// The middles of short steps of the fitted roll, and how many of them end at each record.
struct Steps {
  Column h, x, v, acceleration;
  std::vector<std::size_t> until;  // the first step behind each record
  double way = 0;
};

Steps steps_of(const ObservedRun& run, const Trajectory& roll, double R) {
  constexpr double longest = 0.2;  // of a step, in radians of the body
  Steps steps;
  double before = 0;
  for (double t : run.t) {
    const double angle = (roll.speed_at(before).v) * (t - before) / R;
    const auto count = static_cast<std::size_t>(std::clamp(std::ceil(angle / longest), 1.0, 32.0));
    const double h = (t - before) / static_cast<double>(count);
    for (std::size_t i = 0; h > 0 && i < count; ++i) {
      const auto s = roll.at(before + (static_cast<double>(i) + 0.5) * h);
      steps.h.push_back(h);
      steps.x.push_back(s.x);
      steps.v.push_back(s.v);
      steps.acceleration.push_back(s.v > 0 ? roll.acceleration(s.v) : 0);
    }
    steps.until.push_back(steps.h.size());
    before = t;
  }
  steps.way = steps.x.empty() ? 0 : steps.x.back();
  return steps;
}

/// What the raw column becomes by dD = cos(x/r - phase), to first order. The law is autonomous, so
/// that dv = v' w with w' = -(g cos theta/((K + 1) R)) dD / v'.
Column response(const ObservedRun& run, const Steps& steps, double r, double phase) {
  constexpr double slow = 0.05;  // of v0: w would grow without bound towards the stop
  const double by_D = -run.body.g * incline(run.body).cos / ((run.body.K + 1) * run.body.R);
  Column raw;
  double w = 0, dx = 0, dv = 0;
  std::size_t i = 0;
  for (std::size_t until : steps.until) {
    for (; i < until; ++i) {
      const double force = by_D * std::cos(steps.x[i] / r - phase), half = steps.h[i] / 2;
      const bool rolls = steps.v[i] > slow * steps.v.front();
      const double half_w = rolls ? force / steps.acceleration[i] * half : 0;
      w += half_w;
      dv = steps.acceleration[i] * w;
      dx += dv * steps.h[i];
      w += half_w;
    }
    raw.push_back(run.way * (run.raw_is_position ? dx : dv));
  }
  return raw;
}

/// Takes from `column` what lies along the others, which are orthonormal.
void orthogonalise(Column& column, const std::vector<Column>& others) {
  for (int twice = 0; twice < 2; ++twice)
    for (const Column& other : others) {
      const double along = dot(other.data(), column.data(), column.size());
      for (std::size_t i = 0; i < column.size(); ++i) column[i] -= along * other[i];
    }
}

double norm(const Column& x) { return std::sqrt(dot(x.data(), x.data(), x.size())); }

/// One run of a fit, seen for something periodic.
class Periodogram {
 public:
  Periodogram(const Fitted& fit, std::size_t run, double R, double variance,
              std::span<const double> Q, std::span<const double> f)
      : fit_(fit), run_(run), R_(R), variance_(variance), seen_(fit.rolls->runs()[run]),
        steps_(steps_of(seen_, fit.rolls->trajectory(fit.minimum.theta, run), R)),
        f_(f.begin(), f.end()) {
    const std::size_t q = fit.system.columns();
    for (std::size_t j = 0; j < q; ++j) {
      Column column(f.size());
      for (std::size_t i = 0; i < f.size(); ++i) column[i] = Q[i * q + j];
      const double before = norm(column);
      orthogonalise(column, tangent_);
      const double length = norm(column);
      if (!(length > 1e-9 * before)) continue;
      for (double& x : column) x /= length;
      tangent_.push_back(std::move(column));
    }
  }

  bool worth() const {
    if (f_.size() < 30 || !(steps_.way >= 2 * std::numbers::pi * R_)) return false;
    const double fastest = *std::max_element(steps_.v.begin(), steps_.v.end());
    double longest = 0;
    for (std::size_t i = 1; i < seen_.t.size(); ++i)
      longest = std::max(longest, seen_.t[i] - seen_.t[i - 1]);
    return fastest * longest < std::numbers::pi * R_;
  }

  /// For the period 2 pi R times `stretch`.
  Eccentricity at(double stretch) const {
    // The columns of cos and sin, as the fit sees them, freed of the tangent plane.
    std::vector<Column> C;
    for (double phase : {0.0, std::numbers::pi / 2}) {
      Column column = response(seen_, steps_, stretch * R_, phase);
      if (seen_.H)
        hand_over_filtered(seen_, run_, Column(column), column, *fit_.noise,
                           [&](std::size_t, std::span<double>, std::span<double> J) {
          column.assign(J.begin(), J.end());
        });
      orthogonalise(column, tangent_);
      C.push_back(std::move(column));
    }
    const auto product = [&](const Column& x, const Column& y) {
      return dot(x.data(), y.data(), x.size());
    };
    // f = model - data: least squares of C e = -f.
    const double cc = product(C[0], C[0]), cs = product(C[0], C[1]), ss = product(C[1], C[1]),
                 c = -product(C[0], f_), s = -product(C[1], f_), det = cc * ss - cs * cs;
    if (!(det > 1e-12 * cc * ss)) return {run_, 1, 0, 0, 0};
    const double by_cos = (ss * c - cs * s) / det, by_sin = (cc * s - cs * c) / det;
    const double reduction = by_cos * c + by_sin * s, e = std::hypot(by_cos, by_sin),
                 freedom = static_cast<double>(fit_.minimum.f.size()) -
                           static_cast<double>(fit_.minimum.theta.size()) - 2,
                 variance =
                     variance_ * (1 - reduction / fit_.minimum.rss) * (freedom + 2) / freedom;
    const double along = (by_cos * by_cos * ss - 2 * by_cos * by_sin * cs + by_sin * by_sin * cc);
    return {run_, gsl_cdf_fdist_Q(reduction / variance / 2, 2, freedom), e,
            std::sqrt(variance * along / det) / e, std::atan2(by_sin, by_cos)};
  }

 private:
  const Fitted& fit_;
  std::size_t run_;
  double R_, variance_;
  const ObservedRun& seen_;
  Steps steps_;
  Column f_;
  std::vector<Column> tangent_;
};

}  // namespace

std::optional<Eccentricity> eccentricity_of(Route route, const std::vector<FitRun>& runs,
                                            const Fitted& fit) {
  constexpr double decisive = 0.01;
  const std::size_t n = fit.minimum.f.size(), p = fit.minimum.theta.size(),
                    q = fit.system.columns();
  if (!fit.rolls || n < p + 10) return {};
  const double variance = fit.noise->known() && !fit.noise_inferred
                              ? noise_variance(fit)
                              : fit.minimum.rss / static_cast<double>(n - p);
  const auto Q = orthonormal(fit.system, fit.minimum);
  std::optional<Eccentricity> found;
  std::size_t first = 0;
  for (std::size_t r = 0; r < runs.size(); first += fit.system.runs[r++]) {
    const std::size_t m = fit.system.runs[r];
    const double R = route == Route::shift ? runs[r].shift_of->body.R : runs[r].body.R;
    const Periodogram spectrum(fit, r, R, variance, std::span(Q).subspan(first * q, m * q),
                               std::span(fit.minimum.f).subspan(first, m));
    if (!spectrum.worth()) continue;
    Eccentricity once_a_turn = spectrum.at(1);
    once_a_turn.significance *= static_cast<double>(runs.size());
    if (once_a_turn.significance > decisive ||
        (found && found->significance < once_a_turn.significance))
      continue;
    const double near = std::min(spectrum.at(0.7).significance, spectrum.at(1.4).significance);
    if (once_a_turn.significance < near) found = once_a_turn;
  }
  return found;
}

}  // namespace rolling
