// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/run_laws.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_psi.h>

#include <algorithm>

namespace rolling {
namespace {

/// Computes chi^2 of the distance from one run to the weighted mean of the others, and stores the
/// run in the result if that is more than `most`.
void stand_out(Agreement& result, const OwnLaw& one, Pair others, Symmetric C, double& most) {
  const Pair d = one.law - others;
  C = C + one.covariance;
  const double distance = C.inverse().square(d);
  if (!(distance > most * (1 + 1e-9))) return;  // two runs are as far from each other
  most = distance;
  const OwnLaw difference{one.run, d, C, 0};
  const double log_v = difference.best_log_v();
  result.run = one.run;
  result.speed = std::exp(log_v);
  result.log_D = difference.log_D(log_v);
  result.b = difference.b();
}

/// -2 ln of the ratio of likelihoods, of one common law to laws of the runs' own, where the noise
/// of each run has a size of its own that is an estimate: the sum of c ln(1 + d/nu), with the
/// squared distance d of a run to the common law and its degrees of freedom nu. c is nu times a
/// factor of Bartlett's (1937, Proc. R. Soc. A 160, 268), so that the mean of each term is
/// `parameters`. The weighted mean of the laws does not make this sum smallest: it follows a run
/// whose few rows happen to agree well. Iteratively reweighted means do; since the logarithm is
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

}  // namespace

Estimate OwnLaw::log_D(double log_v) const {
  const Symmetric& C = covariance;
  return {law.a + log_v * law.b,
          std::sqrt(std::max(0.0, C.aa + log_v * (2 * C.ab + log_v * C.bb)))};
}

OwnLaw OwnLaw::in_unit(double log_v) const {
  const Symmetric& C = covariance;
  const Estimate D = log_D(log_v);
  return {run, {D.value, law.b}, {D.sigma * D.sigma, C.ab + log_v * C.bb, C.bb}, freedom};
}

// The sum of least_from() may have several minima: the law of a joint fit is the start that suits
// runs of equal noise, and the weighted mean one that suits unequal ones.
Agreement compare(const std::vector<OwnLaw>& laws, Pair start, std::size_t parameters,
                  std::size_t taken) {
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
  result.dof = parameters * (laws.size() - 1) - taken;
  result.ratio = std::min(least_from(start, laws, parameters), least_from(mean, laws, parameters));
  if (result.dof > 0) result.p = gsl_cdf_chisq_Q(result.ratio, static_cast<double>(result.dof));
  return result;
}

double common_log_v(const std::vector<OwnLaw>& laws,
                    const std::function<double(const OwnLaw&)>& log_v_of) {
  double log_v = 0, weights = 0;
  for (const OwnLaw& one : laws) {
    const double own = log_v_of(one), sigma = one.log_D(own).sigma,
                 weight = sigma > 0 ? 1 / (sigma * sigma) : 1;  // without error if a is fixed
    weights += weight;
    log_v += weight / weights * (own - log_v);
  }
  return log_v;
}

namespace {

RandomEffectsMean mean_of(const std::vector<OwnLaw>& laws, Estimate (*number)(const OwnLaw&),
                          double freedom) {
  std::vector<Estimate> numbers;
  for (const OwnLaw& one : laws) numbers.push_back(number(one));
  return random_effects_mean(numbers, freedom);
}

}  // namespace

ScatteredMean::ScatteredMean(const std::vector<OwnLaw>& laws, double unit, double freedom)
    : log_v(unit), D(mean_of(
                       laws, [](const OwnLaw& one) { return one.log_D(0); }, freedom)),
      b(mean_of(
          laws, [](const OwnLaw& one) { return one.b(); }, freedom)) {}

Symmetric ScatteredMean::square(double log_D, double exponent) const {
  return outer_square({log_D - log_v * exponent, exponent});
}

Symmetric ScatteredMean::covariance() const {
  Symmetric C{};
  for (std::size_t i = 0; i < D.parts.size(); ++i) C = C + square(D.parts[i], b.parts[i]);
  return C;
}

}  // namespace rolling
