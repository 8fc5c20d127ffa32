#include "fit/agreement.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_psi.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "fit/roll_fit.h"
#include "fit/route.h"
#include "statistics/random_effects.h"

namespace rolling {
namespace {

/// ln a and b of a law, or a difference of two laws. In another unit of speed ln a is ln D at that
/// speed.
struct Pair {
  double a, b;
};
/// The covariance of a Pair, or the inverse of one.
struct Symmetric {
  double aa, ab, bb;

  Pair operator*(Pair x) const { return {aa * x.a + ab * x.b, ab * x.a + bb * x.b}; }
  double square(Pair x) const { return x.a * (aa * x.a + 2 * ab * x.b) + x.b * bb * x.b; }
  /// A parameter that is held fixed has a row and a column of zeros; they stay zeros.
  Symmetric inverse() const {
    if (aa == 0 || bb == 0) return {aa == 0 ? 0 : 1 / aa, 0, bb == 0 ? 0 : 1 / bb};
    const double det = aa * bb - ab * ab;
    return {bb / det, -ab / det, aa / det};
  }
  bool is_finite() const { return std::isfinite(aa) && std::isfinite(ab) && std::isfinite(bb); }
  /// True if no variance is negative; a parameter that is held fixed has none.
  bool is_positive() const { return aa >= 0 && bb >= 0 && aa * bb >= ab * ab; }
};
Pair operator+(Pair x, Pair y) { return {x.a + y.a, x.b + y.b}; }
Pair operator-(Pair x, Pair y) { return {x.a - y.a, x.b - y.b}; }
Symmetric operator+(Symmetric X, Symmetric Y) { return {X.aa + Y.aa, X.ab + Y.ab, X.bb + Y.bb}; }
Symmetric operator-(Symmetric X, Symmetric Y) { return {X.aa - Y.aa, X.ab - Y.ab, X.bb - Y.bb}; }
Symmetric operator*(double s, Symmetric X) { return {s * X.aa, s * X.ab, s * X.bb}; }

/// The logarithm of D at the speed exp(log_v), with its standard error.
Estimate log_D_of(Pair law, const Symmetric& C, double log_v) {
  return {law.a + log_v * law.b,
          std::sqrt(std::max(0.0, C.aa + log_v * (2 * C.ab + log_v * C.bb)))};
}
/// The logarithm of the speed at which the error of D is least; D and b are uncorrelated there.
double best_log_v(const Symmetric& C) { return C.bb > 0 ? -C.ab / C.bb : 0; }

/// The law of one run that is fitted by itself.
struct OwnLaw {
  std::size_t run;
  Pair law;
  Symmetric covariance;
  double freedom;  // degrees of freedom of its residuals

  Estimate log_D(double log_v) const { return log_D_of(law, covariance, log_v); }
  Estimate b() const { return {law.b, std::sqrt(covariance.bb)}; }
};

/// The variance of ln a or b that rounding leaves in records without noise; 0 if it is held fixed.
double rounding_of(const std::vector<double>& gradient) {
  const bool held = std::ranges::all_of(gradient, [](double slope) { return slope == 0; });
  return held ? 0 : 1e-26;
}

std::vector<OwnLaw> own_laws(const std::vector<std::optional<Fitted>>& own) {
  std::vector<OwnLaw> laws;
  for (std::size_t r = 0; r < own.size(); ++r) {
    if (!own[r] || own[r]->degrees_left() == 0) continue;
    const Fitted& fit = *own[r];
    const Spread covariance = uncertainty_of(fit).covariance;
    auto by_log_a = fit.a.gradient;
    for (double& slope : by_log_a) slope /= fit.a.value;
    const Symmetric C{covariance(by_log_a, by_log_a) + rounding_of(by_log_a),
                      covariance(by_log_a, fit.b.gradient),
                      covariance(fit.b.gradient, fit.b.gradient) + rounding_of(fit.b.gradient)};
    if (C.is_positive() && C.inverse().is_finite() && determines_b(std::sqrt(C.bb)))
      laws.push_back(
          {r, {std::log(fit.a.value), fit.b.value}, C, static_cast<double>(fit.degrees_left())});
  }
  return laws;
}

/// Computes chi^2 of the distance from one run to the weighted mean of the others, and stores the
/// run in the result if that is more than `most`.
void stand_out(Agreement& result, const OwnLaw& one, Pair others, Symmetric C, double& most) {
  const Pair d = one.law - others;
  C = C + one.covariance;
  const double distance = C.inverse().square(d);
  if (!(distance > most * (1 + 1e-9))) return;  // two runs are as far from each other
  most = distance;
  const double log_v = best_log_v(C);
  result.run = one.run;
  result.speed = std::exp(log_v);
  result.log_D = log_D_of(d, C, log_v);
  result.b = {d.b, std::sqrt(C.bb)};
}

/// The sums for a weighted mean of laws.
struct Weighted {
  Symmetric weights = {};
  Pair sum = {};

  void add(Symmetric weight, Pair law) {
    weights = weights + weight;
    sum = sum + weight * law;
  }
  Pair mean() const { return weights.inverse() * sum; }
};

/// -2 ln of the ratio of likelihoods, of one common law to laws of the runs' own, where the noise
/// of each run has a size of its own that is an estimate: the sum of c ln(1 + d/nu), with the
/// squared distance d of a run to the common law and its degrees of freedom nu. c is nu times a
/// factor of Bartlett's (1937, Proc. R. Soc. A 160, 268), so that the mean of each term is
/// `parameters`. The weighted mean of the laws does not make this sum smallest: it follows a run
/// whose few records happen to agree well. Iteratively reweighted means do; since the logarithm is
/// concave, no step makes the sum larger.
double least_from(Pair common, const std::vector<OwnLaw>& laws, std::size_t parameters) {
  double least = INFINITY;
  for (;;) {
    double sum = 0;
    Weighted next;
    for (const OwnLaw& one : laws) {
      const Symmetric weight = one.covariance.inverse();
      const double nu = one.freedom, d = weight.square(one.law - common),
                   c = static_cast<double>(parameters) /
                       (gsl_sf_psi((nu + static_cast<double>(parameters)) / 2) -
                        gsl_sf_psi(nu / 2));
      sum += c * std::log1p(d / nu);
      next.add(c / (nu + d) * weight, one.law);
    }
    if (!(sum < least * (1 - 1e-10))) return std::min(sum, least);
    least = sum;
    common = next.mean();
  }
}

/// The sum of least_from() may have several minima: `joint`, the law of the joint fit, is the start
/// that suits runs of equal noise, and the weighted mean one that suits unequal ones.
Agreement compare(const std::vector<OwnLaw>& laws, Pair joint, const FitOptions& options) {
  const std::size_t parameters = !options.a + !options.b;
  Weighted all;
  for (const OwnLaw& one : laws) all.add(one.covariance.inverse(), one.law);
  Agreement result{};
  result.runs = laws.size();
  const Pair mean = all.mean();
  double most = -1;
  for (const OwnLaw& one : laws) {
    const Symmetric weight = one.covariance.inverse();
    result.chi2 += weight.square(one.law - mean);
    const Symmetric rest = (all.weights - weight).inverse();
    stand_out(result, one, rest * (all.sum - weight * one.law), rest, most);
  }
  result.dof = parameters * (laws.size() - 1) - options.fit_slope;
  if (result.dof > 0)
    result.significance = gsl_cdf_chisq_Q(
        std::min(least_from(joint, laws, parameters), least_from(mean, laws, parameters)),
        static_cast<double>(result.dof));
  return result;
}

/// The joint fit with the residuals that the runs have around their own laws. The residuals around
/// the common law contain the disagreement of the runs too, and would be taken for correlated or
/// uneven noise. For loglog only the innovations matter: its errors are then those of the means.
Fitted with_own_noise(const Fitted& joint, const std::vector<std::optional<Fitted>>& own) {
  Fitted fit = joint;
  fit.minimum.f.clear();
  if (fit.raw_noise) fit.raw_noise->innovations.clear(), fit.raw_noise->innovation_runs.clear();
  fit.taken.emplace();
  double rss = 0;
  std::size_t left = 0;
  const auto append = [](auto& to, const auto& more) {
    to.insert(to.end(), more.begin(), more.end());
  };
  for (const auto& one : own) {
    if (!one || one->raw_noise.has_value() != joint.raw_noise.has_value()) return joint;
    append(fit.minimum.f, one->minimum.f);
    rss += one->minimum.rss;
    left += one->degrees_left();
    const Taken taken = taken_of(*one);
    std::transform(taken.begin(), taken.end(), fit.taken->begin(), fit.taken->begin(), std::plus());
    if (!one->raw_noise) continue;
    append(fit.raw_noise->innovations, one->raw_noise->innovations);
    append(fit.raw_noise->innovation_runs, one->raw_noise->innovation_runs);
  }
  if (fit.minimum.f.size() != joint.minimum.f.size() || left == 0) return joint;
  // The runs' own fits have more parameters in all than the joint one, and leave smaller residuals:
  // rss/left is the variance. Whoever takes the joint fit divides by its own degrees of freedom,
  // and HC3 takes the residuals themselves.
  const double more = static_cast<double>(joint.degrees_left()) / static_cast<double>(left);
  for (double& x : fit.minimum.f) x *= std::sqrt(more);
  fit.minimum.rss = rss * more;
  return fit;
}

bool of_one_way(const std::vector<OwnLaw>& laws, const Fitted& joint) {
  const auto way = [&](const OwnLaw& one) { return joint.rolls->runs()[one.run].way; };
  return std::all_of(laws.begin(), laws.end(),
                     [&](const OwnLaw& one) { return way(one) == way(laws.front()); });
}

/// The logarithm of the speed to which the ln D of a run belongs: that at which D is known best;
/// or, where b is held and the error of D is the same at all speeds, the mean speed of the roll, at
/// which a slope acts like more D.
double log_v_of(const OwnLaw& one, const Fitted& joint) {
  if (one.covariance.bb > 0 || !joint.rolls) return best_log_v(one.covariance);
  const Trajectory roll = joint.rolls->trajectory(joint.minimum.theta, one.run);
  const double end = std::min(joint.rolls->runs()[one.run].t.back(), roll.stop_time());
  return std::log(roll.distance_at(end) / end);
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
    const double exponent = laws[i].covariance.bb > 0 ? joint.b.value : 0;  // a held one stays
    lost.push_back({by_slope[i], -by_slope[i] * exponent});
    laws[i].law = laws[i].law - Pair{lost[i].a * line.slope, lost[i].b * line.slope};
  }
  return lost;
}

/// The law becomes that of the mean of b and of the mean of ln D at the common speed, where both
/// scatter independently; where the slope is fitted, they are those at the slope at which the runs
/// agree best. The scatter of a itself, which is D at 1 m/s, is that of b if the runs are slower,
/// and would depend on the unit of speed.
void take_means(std::vector<OwnLaw> laws, double freedom, NoiseErrors& errors, Fitted& joint) {
  double log_v = 0, weights = 0;
  for (const OwnLaw& one : laws) {
    const double own = log_v_of(one, joint), sigma = one.log_D(own).sigma,
                 weight = sigma > 0 ? 1 / (sigma * sigma) : 1;  // without error if a is held
    weights += weight;
    log_v += weight / weights * (own - log_v);
  }
  const double common_D = joint.a.value * std::exp(joint.b.value * log_v);
  for (OwnLaw& one : laws) {  // ln D in the place of ln a: the unit of speed is the common one
    const Symmetric& C = one.covariance;
    const Estimate D = one.log_D(log_v);
    one = {
        one.run, {D.value, one.law.b}, {D.sigma * D.sigma, C.ab + log_v * C.bb, C.bb}, one.freedom};
  }
  BySlope by_slope(laws.size());
  if (joint.slope) by_slope = take_slope(laws, common_D, freedom, errors, joint);
  std::vector<Estimate> Ds, bs;
  for (const OwnLaw& one : laws) Ds.push_back(one.log_D(0)), bs.push_back(one.b());
  const RandomEffectsMean D = random_effects_mean(Ds, freedom),
                          b = random_effects_mean(bs, freedom);
  Symmetric C{};  // of ln a and b
  const auto add = [&](double log_D, double exponent) {
    const double log_a = log_D - log_v * exponent;
    C = C + Symmetric{log_a * log_a, log_a * exponent, exponent * exponent};
  };
  Pair lost{};
  for (std::size_t i = 0; i < laws.size(); ++i) {
    lost = lost + Pair{D.shares[i] * by_slope[i].a, b.shares[i] * by_slope[i].b};
    add(D.parts[i], b.parts[i]);
  }
  add(lost.a * errors.share.slope, lost.b * errors.share.slope);
  if (b.free) joint.b.value = b.value;
  if (D.free) joint.a.value = std::exp(D.value - log_v * joint.b.value);
  const double a = joint.a.value;
  errors.share.a = a * std::sqrt(C.aa), errors.share.b = std::sqrt(C.bb);
  errors.share.together = a * C.ab;
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
  if (freedom < 1 || (options.fit_slope && (options.a || of_one_way(laws, joint)))) return false;
  take_means(std::move(laws), freedom, errors, joint);
  return true;
}

}  // namespace

std::optional<Agreement> agreement_of(Route route, const std::vector<FitRun>& runs,
                                      const FitOptions& options, NoiseErrors& errors,
                                      Fitted& joint) {
  if (runs.size() < 2 || errors.kind == Errors::none || (options.a && options.b)) return {};
  const auto own = own_fits(route, runs, options, joint);
  const auto laws = own_laws(own);
  if (laws.size() < 2) return {};
  const Pair common{std::log(joint.a.value), joint.b.value};
  const Agreement found = compare(laws, common, options);
  if (found.agree()) return found;
  const Fitted around_own = with_own_noise(joint, own);
  errors = noise_errors(around_own, uncertainty_of(around_own));
  // The bias of logarithms comes from the noise too.
  joint.bias_a = joint.bias_b = 0;
  for (const OwnLaw& one : laws) {
    joint.bias_a += own[one.run]->bias_a / static_cast<double>(laws.size());
    joint.bias_b += own[one.run]->bias_b / static_cast<double>(laws.size());
  }
  if (!follow_means(laws, options, errors, joint))
    errors.multiply(std::max(1.0, std::sqrt(found.chi2 / static_cast<double>(found.dof))));
  return found;
}

Fitted fit_of_disagreeing(Route route, const std::vector<FitRun>& runs, const FitOptions& options) {
  Fitted joint = fit_route(route, runs, options);
  NoiseErrors unused{};
  follow_means(own_laws(own_fits(route, runs, options, joint)), options, unused, joint);
  return joint;
}

}  // namespace rolling
