// SPDX-License-Identifier: GPL-3.0-or-later
#include "statistics/run_laws.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_psi.h>

#include <algorithm>

namespace rolling {
namespace {

/// Computes chi^2 of the distance from one run to the weighted mean of the others, and stores the
/// run in the result if that is more than `most`.
void stand_out(Agreement& result, const OwnLaw& one, Pair others, Symmetric C,
               std::size_t parameters, double fastest, double& most) {
  const Pair d = one.law - others;
  C = C + one.covariance;
  const double distance = C.inverse().square(d);
  if (!(distance > most * (1 + 1e-9))) return;  // two runs are as far from each other
  most = distance;
  const OwnLaw difference{one.run, d, C, 0};
  const double log_v = std::min(difference.best_log_v(), std::log(fastest));
  result.run = one.run;
  result.speed = std::exp(log_v);
  result.log_D = difference.log_D(log_v);
  result.b = difference.b();
  result.p_of_run = p_of_run(distance, one.freedom, parameters);
}

/// nu, of a run, times a factor of Bartlett's (1937, Proc. R. Soc. A 160, 268).
double bartlett(double nu, std::size_t parameters) {
  const auto p = static_cast<double>(parameters);
  return p / (gsl_sf_psi((nu + p) / 2) - gsl_sf_psi(nu / 2));
}

/// The least sum of ratio_of_run(). The weighted mean of the laws does not make it smallest: it
/// follows a run whose few rows happen to agree well. Iteratively reweighted means do; since the
/// logarithm is concave, no step makes the sum larger.
double least_from(Pair common, const std::vector<OwnLaw>& laws, std::size_t parameters) {
  double least = INFINITY;
  for (;;) {
    double sum = 0;
    Weighted next;
    for (const OwnLaw& one : laws) {
      const Symmetric weight = one.covariance.inverse();
      const double nu = one.freedom;
      const double d = weight.square(one.law - common);
      sum += ratio_of_run(d, nu, parameters);
      next.add(bartlett(nu, parameters) / (nu + d) * weight, one.law);
    }
    if (!(sum < least * (1 - 1e-10))) return std::min(sum, least);
    least = sum;
    common = next.mean();
  }
}

}  // namespace

double ratio_of_run(double distance, double freedom, std::size_t parameters) {
  return bartlett(freedom, parameters) * std::log1p(distance / freedom);
}

double p_of_run(double distance, double freedom, std::size_t parameters) {
  const auto p = static_cast<double>(parameters);
  return gsl_cdf_fdist_Q(distance / p, p, freedom);
}

Estimate OwnLaw::log_D(double log_v) const {
  const Symmetric& C = covariance;
  return {law.a + log_v * law.b,
          std::sqrt(std::max(0.0, C.aa + log_v * (2 * C.ab + log_v * C.bb)))};
}

Agreement compare(const std::vector<OwnLaw>& laws, std::size_t parameters, std::size_t taken,
                  double fastest) {
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
    stand_out(result, one, rest * (all.sum - weight * one.law), rest, parameters, fastest, most);
  }
  result.p_of_run = std::min(1.0, result.p_of_run * static_cast<double>(laws.size()));
  const std::size_t differences = parameters * (laws.size() - 1);
  result.dof = differences - std::min(differences, taken);
  result.ratio = least_from(mean, laws, parameters);
  if (result.dof > 0) result.p = gsl_cdf_chisq_Q(result.ratio, static_cast<double>(result.dof));
  return result;
}

double common_log_v(const std::vector<OwnLaw>& laws,
                    const std::function<double(const OwnLaw&)>& log_v_of) {
  double log_v = 0;
  double weights = 0;
  for (const OwnLaw& one : laws) {
    const double own = log_v_of(one);
    const double sigma = one.log_D(own).sigma;
    const double weight = sigma > 0 ? 1 / (sigma * sigma) : 1;  // without error if a is fixed
    weights += weight;
    log_v += weight / weights * (own - log_v);
  }
  return log_v;
}

JointLaw scattered_mean(const std::vector<OwnLaw>& laws, double log_v, double freedom,
                        const std::vector<CommonError>& common) {
  const auto mean_of = [&](const auto& number) {
    std::vector<Estimate> numbers;
    for (const OwnLaw& one : laws) numbers.push_back(number(one));
    return random_effects_mean(numbers, freedom);
  };
  const auto D = mean_of([&](const OwnLaw& one) { return one.log_D(log_v); });
  const auto D_at_unit = mean_of([](const OwnLaw& one) { return one.log_D(0); });
  const auto b = mean_of([](const OwnLaw& one) { return one.b(); });
  JointLaw mean{.law = in_unit({D.value, b.value}, -log_v),
                .covariance = {},
                .scatter_log_a = std::sqrt(D_at_unit.tau_square),
                .scatter_b = std::sqrt(b.tau_square)};
  const auto add = [&](Pair error) {
    mean.covariance = mean.covariance + outer_square(in_unit(error, -log_v));
  };
  for (std::size_t i = 0; i < laws.size(); ++i) add({D.parts[i], b.parts[i]});
  for (const CommonError& error : common) {
    Pair all{};
    for (std::size_t i = 0; i < laws.size(); ++i) {
      const Pair one = in_unit(error[i], log_v);
      all = all + Pair{D.shares[i] * one.a, b.shares[i] * one.b};
    }
    add(all);
  }
  return mean;
}

namespace {

/// The variance of the noise if it is of one size in all runs, else 0: Bartlett's test.
double common_variance(const std::vector<OwnLaw>& laws) {
  double freedom = 0;
  double squares = 0;
  double logarithms = 0;
  double inverse = 0;
  for (const OwnLaw& one : laws) {
    if (!(one.rms > 0)) return 0;
    const double nu = one.freedom;
    const double variance = one.rms * one.rms;
    freedom += nu;
    squares += nu * variance;
    logarithms += nu * std::log(variance);
    inverse += 1 / nu;
  }
  const double variance = squares / freedom;
  const double others = static_cast<double>(laws.size()) - 1;
  const double correction = 1 + (inverse - 1 / freedom) / (3 * others);
  const double chi2 = (freedom * std::log(variance) - logarithms) / correction;
  return gsl_cdf_chisq_Q(std::max(0.0, chi2), others) > levels::uneven ? variance : 0;
}

}  // namespace

JointLaw joint_law(const std::vector<OwnLaw>& laws, const std::vector<CommonError>& common) {
  const double variance = common_variance(laws);
  std::vector<Symmetric> weights;
  Weighted all;
  for (const OwnLaw& one : laws) {
    const double size = variance > 0 ? variance / (one.rms * one.rms) : 1;
    weights.push_back((size * one.covariance).inverse());
    all.add(weights.back(), one.law);
  }
  const Symmetric& C = laws.front().covariance;
  JointLaw joint{.law = all.mean(), .covariance = all.weights.inverse()};
  if (C.aa == 0) joint.law.a = laws.front().law.a;
  if (C.bb == 0) joint.law.b = laws.front().law.b;
  joint.agreement = compare(laws, static_cast<std::size_t>(C.aa > 0) + (C.bb > 0), 0);
  joint.agreement.of_mean = true;
  if (!joint.agreement.agree()) {
    const double log_v = common_log_v(laws, [](const OwnLaw& one) { return one.best_log_v(); });
    JointLaw mean = scattered_mean(laws, log_v, static_cast<double>(laws.size()) - 1, common);
    mean.agreement = joint.agreement;
    return mean;
  }
  const Symmetric V = joint.covariance;
  for (const CommonError& error : common) {
    Pair share{};
    for (std::size_t i = 0; i < laws.size(); ++i) share = share + weights[i] * error[i];
    joint.covariance = joint.covariance + outer_square(V * share);
  }
  return joint;
}

}  // namespace rolling
