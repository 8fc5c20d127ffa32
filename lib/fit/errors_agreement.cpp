// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/errors.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "fit/fitted.h"
#include "fit/roll_fit.h"
#include "fit/run_laws.h"

namespace rolling {
namespace {

/// ln a and b, with their gradients: of another law, of the v^b with the same D at this speed and
/// at a quarter of it.
struct LocalPower {
  FittedNumber log_a, b;
};
LocalPower local_power(const Fitted& fit, double v) {
  const Law law = fit.parameters->law(fit.minimum.theta);
  const std::size_t n = fit.parameters->columns();
  if (law.power()) {
    FittedNumber log_a{std::log(fit.coefficients[0].value), fit.coefficients[0].gradient};
    for (double& slope : log_a.gradient) slope /= fit.coefficients[0].value;
    return {std::move(log_a), fit.coefficients[1]};
  }
  const auto log_D = [&](double speed) {
    std::array<double, LawForm::most> by_c{};
    const double D = law.at(speed, by_c.data()).D;
    for (double& by : by_c) by /= D;
    FittedNumber number{std::log(D), std::vector<double>(n)};
    fit.parameters->chain(number.gradient.data(), 1, law.c(0), {by_c});
    return number;
  };
  const FittedNumber fast = log_D(v), slow = log_D(v / 4);
  LocalPower power{fast, fast};
  const auto set = [&](double& log_a, double& b, double of_fast, double of_slow) {
    b = (of_fast - of_slow) / std::log(4.0);
    log_a = of_fast - b * std::log(v);
  };
  set(power.log_a.value, power.b.value, fast.value, slow.value);
  for (std::size_t i = 0; i < n; ++i)
    set(power.log_a.gradient[i], power.b.gradient[i], fast.gradient[i], slow.gradient[i]);
  return power;
}

/// The laws of the runs that determine one, compared at speeds up to v.
std::vector<OwnLaw> own_laws(const std::vector<std::optional<Fitted>>& own, double v) {
  std::vector<OwnLaw> laws;
  for (std::size_t r = 0; r < own.size(); ++r) {
    if (!own[r] || own[r]->degrees_left() == 0) continue;
    const Fitted& fit = *own[r];
    const Spread covariance = uncertainty_of(fit).covariance;
    const auto [log_a, b] = local_power(fit, v);
    const auto variance = [&](const FittedNumber& x) {
      constexpr double of_rounding = 1e-26;  // in rows without noise
      return covariance(x.gradient, x.gradient) + (x.fixed() ? 0 : of_rounding);
    };
    const Symmetric C{variance(log_a), covariance(log_a.gradient, b.gradient), variance(b)};
    if (C.is_positive() && C.inverse().is_finite() && determines_b(std::sqrt(C.bb)))
      laws.push_back({r, {log_a.value, b.value}, C, static_cast<double>(fit.degrees_left())});
  }
  return laws;
}

/// The noise that the runs show around their own laws. The residuals around the common law contain
/// the disagreement of the runs too, and would be taken for correlated or uneven noise. That noise,
/// where not all runs have a law.
SeenNoise noise_around_own(const Fitted& joint, const std::vector<std::optional<Fitted>>& own) {
  SeenNoise of_joint = seen_noise(joint);
  SeenNoise all = of_joint;
  all.innovations.clear(), all.runs.clear(), all.left.clear(), all.e.clear();
  all.taken = {}, all.variance = 0;
  std::size_t left = 0;
  const auto append = [](auto& to, const auto& more) {
    to.insert(to.end(), more.begin(), more.end());
  };
  for (const auto& one : own) {
    if (!one) return of_joint;
    const SeenNoise seen = seen_noise(*one);
    append(all.innovations, seen.innovations);
    append(all.runs, seen.runs);
    append(all.e, seen.e);
    std::ranges::transform(seen.taken, all.taken, all.taken.begin(), std::plus());
    if (seen.freedom == 0) continue;  // it shows no noise
    all.variance += seen.variance * static_cast<double>(seen.freedom);
    left += seen.freedom;
  }
  if (all.innovations.size() != of_joint.innovations.size() || all.e.size() != of_joint.e.size() ||
      left == 0)
    return of_joint;
  all.variance /= static_cast<double>(left);
  // The runs' own fits have more parameters in all than the joint one, and leave smaller residuals,
  // which HC3 takes themselves.
  const double more = static_cast<double>(of_joint.freedom) / static_cast<double>(left);
  for (double& x : all.e) x *= std::sqrt(more);
  return all;
}

bool of_one_way(const std::vector<OwnLaw>& laws, const Fitted& joint) {
  const auto way = [&](const OwnLaw& one) { return joint.rolls->runs()[one.run].way; };
  return std::all_of(laws.begin(), laws.end(),
                     [&](const OwnLaw& one) { return way(one) == way(laws.front()); });
}

/// The logarithm of the speed to which the ln D of a run belongs: that at which D is known best;
/// or, where b is fixed and D has the same error at all speeds, the mean speed of the roll, at
/// which a slope acts like more D.
double log_v_of(const OwnLaw& one, const Fitted& joint) {
  if (one.covariance.bb > 0 || !joint.rolls) return one.best_log_v();
  Roll roll = joint.rolls->roll(joint.minimum.theta, one.run);
  const double last = joint.rolls->runs()[one.run].t.back(),
               end = std::min(last, roll.stop_until(last));
  return std::log(roll.at(end).x / end);
}

/// What a run's ln D and b lose where the slope of the mat grows, to first order.
using BySlope = std::vector<Pair>;

/// Finds the slope S of the mat at which the runs of both directions agree best, and moves the laws
/// (ln D and b) to that slope. R S acts like a shift along the way: ln D changes by -way R S/D, and
/// its derivative by ln v, the exponent, by b times as much the other way. A run that is alone in
/// its direction has no residual; so the error comes from the residuals of all runs together, each
/// expected to be as large as its weight says.
BySlope take_slope(std::vector<OwnLaw>& laws, double D, double freedom, NoiseErrors& errors,
                   Fitted& joint) {
  std::vector<Estimate> log_D;
  std::vector<double> by_slope;
  for (const OwnLaw& one : laws) {
    const ObservedRun& run = joint.rolls->runs()[one.run];
    log_D.push_back(one.log_D(0));
    by_slope.push_back(run.way * run.body.R / D);
  }
  const RandomEffectsLine line = random_effects_line(log_D, by_slope, freedom);
  joint.slope->value += line.slope;
  errors.share.slope = student(freedom) * std::sqrt(line.chi2 / freedom / line.spread);
  BySlope lost;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const double exponent =
        laws[i].covariance.bb > 0 ? joint.coefficients[1].value : 0;  // a fixed one stays
    lost.push_back({by_slope[i], -by_slope[i] * exponent});
    laws[i].law = laws[i].law - Pair{lost[i].a * line.slope, lost[i].b * line.slope};
  }
  return lost;
}

/// The law becomes the ScatteredMean of the runs; where the slope is fitted, that at the slope at
/// which the runs agree best.
void take_means(std::vector<OwnLaw> laws, double freedom, NoiseErrors& errors, Fitted& joint) {
  const double log_v = common_log_v(laws, [&](const OwnLaw& one) { return log_v_of(one, joint); });
  auto &a = joint.coefficients[0].value, &b = joint.coefficients[1].value;
  const double common_D = a * std::exp(b * log_v);
  for (OwnLaw& one : laws) one = one.in_unit(log_v);
  BySlope by_slope(laws.size());
  if (joint.slope) by_slope = take_slope(laws, common_D, freedom, errors, joint);
  const ScatteredMean mean(laws, log_v, freedom);
  Pair lost{};
  for (std::size_t i = 0; i < laws.size(); ++i)
    lost = lost + Pair{mean.D.shares[i] * by_slope[i].a, mean.b.shares[i] * by_slope[i].b};
  const double by = errors.share.slope;
  const Symmetric C = mean.covariance() + mean.square(lost.a * by, lost.b * by);
  if (mean.b.free) b = mean.b.value;
  if (mean.D.free) a = std::exp(mean.D.value - log_v * b);
  errors.share.law = {{a * a * C.aa, a * C.ab}, {a * C.ab, C.bb}};
}

/// Each run fitted by itself; nothing for one that does not determine a law.
std::vector<std::optional<Fitted>> own_fits(Route route, const std::vector<FitRun>& runs,
                                            const FitOptions& options, const Fitted& joint) {
  std::vector<std::optional<Fitted>> own;
  for (std::size_t r = 0; r < runs.size(); ++r) try {
      own.emplace_back(joint.rolls ? fit_of_run(joint, r, options)
                                   : fit_route(route, {runs[r]}, options));
    } catch (const Error&) {
      own.emplace_back();
    }
  return own;
}

/// Takes the means of runs that disagree; returns false, and does nothing, where the law stays that
/// of the joint fit.
bool follow_means(std::vector<OwnLaw> laws, const FitOptions& options, NoiseErrors& errors,
                  Fitted& joint) {
  const double freedom = static_cast<double>(laws.size()) - 1 - options.fit_slope;
  if (freedom < 1 || !options.fits_power() ||
      (options.fit_slope && (options.a || of_one_way(laws, joint))))
    return false;
  take_means(std::move(laws), freedom, errors, joint);
  return true;
}

}  // namespace

std::optional<Agreement> agreement_of(Route route, const std::vector<FitRun>& runs,
                                      const FitOptions& options, NoiseErrors& errors,
                                      Fitted& joint) {
  if (runs.size() < 2 || errors.kind == Errors::none || (options.a && options.b)) return {};
  const auto own = own_fits(route, runs, options, joint);
  const auto laws = own_laws(own, joint.fastest());
  if (laws.size() < 2) return {};
  const auto [log_a, b] = local_power(joint, joint.fastest());
  const bool b_held = options.b || joint.coefficients.size() < 2;
  const Agreement found =
      compare(laws, {log_a.value, b.value}, !options.a + !b_held, options.fit_slope);
  if (found.agree()) return found;
  errors = noise_errors(joint, uncertainty_of(joint, noise_around_own(joint, own)));
  // The bias of logarithms comes from the noise too.
  joint.bias.clear();
  for (const OwnLaw& one : laws)
    for (std::size_t j = 0; j < own[one.run]->bias.size(); ++j) {
      joint.bias.resize(joint.coefficients.size());
      joint.bias[j] += own[one.run]->bias[j] / static_cast<double>(laws.size());
    }
  if (!follow_means(laws, options, errors, joint))
    errors.multiply(std::max(1.0, std::sqrt(found.chi2 / static_cast<double>(found.dof))));
  return found;
}

Fitted fit_of_disagreeing(Route route, const std::vector<FitRun>& runs, const FitOptions& options) {
  Fitted joint = fit_route(route, runs, options);
  NoiseErrors unused{};
  follow_means(own_laws(own_fits(route, runs, options, joint), joint.fastest()), options, unused,
               joint);
  return joint;
}

}  // namespace rolling
