// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/refits.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "base/error.h"
#include "fit/fitted.h"
#include "fit/routes.h"
#include "statistics/run_laws.h"

namespace rolling {
namespace {

/// ln a and b of a law, and their derivatives by its coefficients: of another law, of the v^b with
/// the same D at this speed and at a quarter of it.
std::pair<Pair, std::vector<Pair>> local_power(const Fitted& fit, double v) {
  const Law law = fit.law();
  if (const auto power = law.power())
    return {{std::log(power->a), power->b}, {{1 / power->a, 0}, {0, 1}}};
  std::array<double, LawForm::most> by_fast{};
  std::array<double, LawForm::most> by_slow{};
  const double fast = law.at(v, by_fast.data()).D;
  const double slow = law.at(v / 4, by_slow.data()).D;
  const auto through = [&](double of_fast, double of_slow) {
    const double b = (of_fast - of_slow) / std::log(4.0);
    return Pair{of_fast - b * std::log(v), b};
  };
  std::vector<Pair> by_c;
  for (std::size_t j = 0; j < law.size(); ++j)
    by_c.push_back(through(by_fast[j] / fast, by_slow[j] / slow));
  return {through(std::log(fast), std::log(slow)), by_c};
}

/// The laws of the runs that determine one, compared at speeds up to v.
std::vector<OwnLaw> own_laws(const std::vector<std::optional<Fitted>>& own, double v) {
  std::vector<OwnLaw> laws;
  for (std::size_t r = 0; r < own.size(); ++r) {
    if (!own[r] || own[r]->degrees_left() == 0) continue;
    const Fitted& fit = *own[r];
    const Matrix of_c = uncertainty_of(fit).covariance;
    const auto [law, by_c] = local_power(fit, v);
    const auto of_rounding = [&](std::size_t j) {  // in rows without noise
      return fit.law().power() && fit.parameters().fixed(j) ? 0 : 1e-26;
    };
    Symmetric C{of_rounding(0), 0, of_rounding(1)};
    for (std::size_t i = 0; i < by_c.size(); ++i)
      for (std::size_t j = 0; j < by_c.size(); ++j)
        C = C + of_c[i][j] *
                    Symmetric{by_c[i].a * by_c[j].a, by_c[i].a * by_c[j].b, by_c[i].b * by_c[j].b};
    if (C.is_positive() && C.inverse().is_finite() && std::sqrt(C.bb) <= levels::largest_sigma_b)
      laws.push_back({r, law, C, static_cast<double>(fit.degrees_left())});
  }
  return laws;
}

/// The joint fit with the residuals of the runs around their own laws, if all have one. Those
/// around the common law contain the disagreement of the runs too, and would be taken for
/// correlated or uneven noise.
Fitted around_own(const Fitted& joint, const std::vector<std::optional<Fitted>>& own) {
  std::vector<double> f;
  std::size_t left = 0;
  for (const auto& one : own) {
    if (!one) return joint;
    f.insert(f.end(), one->minimum.f.begin(), one->minimum.f.end());
    left += one->degrees_left();
  }
  if (f.size() != joint.minimum.f.size() || left == 0) return joint;
  // The runs' own fits have more parameters in all than the joint one, and leave smaller residuals.
  const double more = static_cast<double>(joint.degrees_left()) / static_cast<double>(left);
  for (double& x : f) x *= std::sqrt(more);
  Fitted around = joint;
  around.minimum.rss = dot(f, f);
  around.minimum.f = std::move(f);
  return around;
}

/// The logarithm of the speed to which the ln D of a run belongs: that at which D is known best;
/// or, where b is fixed and D has the same error at all speeds, the mean speed of the roll, at
/// which a slope acts like more D.
double log_v_of(const OwnLaw& one, const Fitted& joint) {
  if (one.covariance.bb > 0 || !joint.is_roll()) return one.best_log_v();
  Roll roll = joint.roll(one.run);
  const double last = joint.model.runs()[one.run].t.back();
  const double end = std::min(last, roll.stop_until(last));
  return std::log(roll.at(end).x / end);
}

/// Finds the slope S of the mat at which the runs of both directions agree best in ln D at a speed,
/// and moves the laws to that slope; returns the error of S as one that the laws have in common.
/// R S acts like a shift along the way: ln D changes by -way R S/D, and its derivative by ln v, the
/// exponent, by b times as much the other way. A run that is alone in its direction has no
/// residual; so the error comes from the residuals of all runs together, each expected to be as
/// large as its weight says.
CommonError take_slope(std::vector<OwnLaw>& laws, double log_v, double freedom, Fitted& joint,
                       double& sigma) {
  const double D = joint.law()(std::exp(log_v));
  std::vector<Estimate> log_D;
  std::vector<double> by_slope;
  for (const OwnLaw& one : laws) {
    const ObservedRun& run = joint.model.runs()[one.run];
    log_D.push_back(one.log_D(log_v));
    by_slope.push_back(run.way * run.body.R / D);
  }
  const RandomEffectsLine line = random_effects_line(log_D, by_slope, freedom);
  joint.scene.front().value += line.slope;
  sigma = student(freedom) * std::sqrt(line.chi2 / freedom / line.spread);
  CommonError common;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const double exponent =
        laws[i].covariance.bb > 0 ? joint.coefficients[1].value : 0;  // a fixed one stays
    const Pair lost = in_unit({by_slope[i], -by_slope[i] * exponent}, -log_v);
    laws[i].law = laws[i].law - line.slope * lost;
    common.push_back(sigma * lost);
  }
  return common;
}

/// The law of runs that disagree becomes their scattered_mean(); where the slope is fitted, that at
/// the slope at which they agree best. Returns the covariance of a, b and the slope; or nothing,
/// and does nothing, if the law stays that of the joint fit: another number of the scene is fitted
/// too, for example.
std::optional<Matrix> take_means(std::vector<OwnLaw> laws, const FitOptions& options,
                                 Fitted& joint) {
  const double freedom = static_cast<double>(laws.size()) - 1 - options.fit_slope;
  const auto way = [&](const OwnLaw& one) { return joint.model.runs()[one.run].way; };
  const bool of_one_way = std::ranges::adjacent_find(laws, std::not_equal_to(), way) == laws.end();
  const bool of_slope_alone = joint.scene.size() == static_cast<std::size_t>(options.fit_slope);
  if (freedom < 1 || !options.fits_power() || !of_slope_alone ||
      (options.fit_slope && (options.fixed[0] || of_one_way)))
    return {};
  const double log_v = common_log_v(laws, [&](const OwnLaw& one) { return log_v_of(one, joint); });
  std::vector<CommonError> common;
  double sigma_slope = 0;
  if (options.fit_slope) common.push_back(take_slope(laws, log_v, freedom, joint, sigma_slope));
  const JointLaw mean = scattered_mean(laws, log_v, freedom, common);
  double& a = joint.coefficients[0].value;
  double& b = joint.coefficients[1].value;
  if (!options.fixed[0]) a = std::exp(mean.law.a);
  if (!options.fixed[1]) b = mean.law.b;
  const Symmetric& C = mean.covariance;
  return Matrix{
      {a * a * C.aa, a * C.ab, 0}, {a * C.ab, C.bb, 0}, {0, 0, sigma_slope * sigma_slope}};
}

/// Each run fitted by itself; nothing for one that does not determine a law.
std::vector<std::optional<Fitted>> own_fits(Route route, const std::vector<Run>& runs,
                                            const FitOptions& options, const Fitted& joint) {
  std::vector<std::optional<Fitted>> own;
  for (std::size_t r = 0; r < runs.size(); ++r) try {
      own.emplace_back(joint.is_roll() ? fit_of_run(joint, r, options)
                                       : fit_route(route, {runs[r]}, options));
    } catch (const Error&) {
      own.emplace_back();
    }
  return own;
}

/// Compares the runs by their readings: by how much the sum of squares of a run is larger under the
/// common law than under its own, in units of the variance of its noise. The covariance of a run's
/// law assumes a linear model, which that of d0 + a v^b is not over the errors of a single roll;
/// the sum of squares assumes none. The runs disagree only if both tests say so.
void compare_by_readings(Agreement& found, const std::vector<std::optional<Fitted>>& own,
                         const Fitted& joint) {
  const auto residuals = by_run(joint.minimum.f, joint.model.rows());
  double ratio = 0;
  double p = 1;
  std::size_t runs = 0;
  std::size_t parameters = 0;
  for (std::size_t r = 0; r < own.size(); ++r) {
    if (!own[r] || own[r]->degrees_left() == 0) continue;
    const Minimum& alone = own[r]->minimum;
    if (residuals[r].size() != alone.f.size()) return;
    const auto freedom = static_cast<double>(own[r]->degrees_left());
    const double rise = std::max(dot(residuals[r], residuals[r]) - alone.rss, 0.0);
    parameters = own[r]->parameters().shared();
    ratio += ratio_of_run(rise / alone.rss * freedom, freedom, parameters);
    p = std::min(p, p_of_run(rise / alone.rss * freedom, freedom, parameters));
    ++runs;
  }
  const std::size_t differences = parameters * (runs - 1);
  if (differences <= joint.scene.size()) return;
  const auto dof = static_cast<double>(differences - joint.scene.size());
  found.p = std::max(found.p, gsl_cdf_chisq_Q(ratio, dof));
  found.p_of_run = std::max(found.p_of_run, std::min(1.0, p * static_cast<double>(runs)));
}

}  // namespace

std::optional<Agreement> agreement_of(Route route, const std::vector<Run>& runs,
                                      const FitOptions& options, Uncertainty& errors,
                                      Fitted& joint) {
  if (runs.size() < 2 || errors.kind == Errors::none) return {};
  const std::size_t free = joint.parameters().coefficients();
  if (free == 0) return {};
  const auto own = own_fits(route, runs, options, joint);
  const auto laws = own_laws(own, joint.fastest());
  if (laws.size() < 2) return {};
  Agreement found =
      compare(laws, std::min<std::size_t>(free, 2), joint.scene.size(), joint.fastest());
  if (joint.is_roll()) compare_by_readings(found, own, joint);
  if (found.agree()) return found;
  errors = uncertainty_of(around_own(joint, own));
  // The bias of logarithms comes from the noise too.
  joint.bias.clear();
  for (const OwnLaw& one : laws)
    for (std::size_t j = 0; j < own[one.run]->bias.size(); ++j) {
      joint.bias.resize(joint.coefficients.size());
      joint.bias[j] += own[one.run]->bias[j] / static_cast<double>(laws.size());
    }
  const std::size_t shared = joint.coefficients.size() + joint.scene.size();
  const auto of_means = take_means(laws, options, joint);
  found.of_mean = of_means.has_value();
  for (std::size_t i = 0; i < errors.covariance.size(); ++i)
    for (std::size_t j = 0; j < errors.covariance.size(); ++j) {
      double& both = errors.covariance[i][j];
      if (!of_means) both *= std::max(1.0, found.chi2 / static_cast<double>(found.dof));
      else if (i < shared && j < shared) both = (*of_means)[i][j];
    }
  return found;
}

Fitted fit_of_disagreeing(Route route, const std::vector<Run>& runs, const FitOptions& options) {
  Fitted joint = fit_route(route, runs, options);
  take_means(own_laws(own_fits(route, runs, options, joint), joint.fastest()), options, joint);
  return joint;
}

}  // namespace rolling
