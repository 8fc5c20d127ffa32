// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/joint_law.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>

namespace rolling {
namespace {

/// The variance of the noise if it is of one size in all rows, else 0: Bartlett's test.
double common_variance(const std::vector<LawRow>& rows) {
  double freedom = 0, squares = 0, logarithms = 0, inverse = 0;
  for (const LawRow& row : rows) {
    if (!(row.rms > 0)) return 0;
    const double nu = row.own.freedom, variance = row.rms * row.rms;
    freedom += nu;
    squares += nu * variance;
    logarithms += nu * std::log(variance);
    inverse += 1 / nu;
  }
  const double variance = squares / freedom, others = static_cast<double>(rows.size()) - 1,
               correction = 1 + (inverse - 1 / freedom) / (3 * others),
               chi2 = (freedom * std::log(variance) - logarithms) / correction;
  return gsl_cdf_chisq_Q(std::max(0.0, chi2), others) > levels::uneven ? variance : 0;
}

/// The covariances, of rows whose noise is of one size with that size.
std::vector<Symmetric> covariances_of(const std::vector<LawRow>& rows) {
  const double variance = common_variance(rows);
  std::vector<Symmetric> all;
  for (const LawRow& row : rows)
    all.push_back((variance > 0 ? variance / (row.rms * row.rms) : 1) * row.own.covariance);
  return all;
}

/// Rows that do not agree: their mean, and how much they scatter.
void take_scatter(JointLaw& joint, std::vector<OwnLaw> laws,
                  const std::vector<CommonError>& common) {
  const double freedom = static_cast<double>(laws.size()) - 1;
  const ScatteredMean at_unit_speed(laws, 0, freedom);
  joint.scatter_log_a = std::sqrt(at_unit_speed.D.tau_square);
  joint.scatter_b = std::sqrt(at_unit_speed.b.tau_square);
  const double log_v = common_log_v(laws, [](const OwnLaw& one) { return one.best_log_v(); });
  for (OwnLaw& one : laws) one = one.in_unit(log_v);
  const ScatteredMean mean(laws, log_v, freedom);
  if (mean.b.free) joint.law.b = mean.b.value;
  if (mean.D.free) joint.law.a = mean.D.value - log_v * joint.law.b;
  joint.covariance = mean.covariance();
  for (const CommonError& error : common) {
    double share = 0;
    for (const std::size_t row : error.rows) share += mean.D.shares[row];
    joint.covariance = joint.covariance + mean.square(share * error.log_a, 0);
  }
}

}  // namespace

JointLaw joint_law(std::vector<LawRow> rows, const std::vector<CommonError>& common) {
  std::vector<OwnLaw> laws;
  Weighted all;
  const auto covariances = covariances_of(rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    laws.push_back(rows[i].own);
    laws.back().run = i;
    all.add(covariances[i].inverse(), laws.back().law);
  }
  const Symmetric C = covariances.front();
  JointLaw joint{.law = all.mean(), .covariance = all.weights.inverse()};
  if (C.aa == 0) joint.law.a = laws.front().law.a;
  if (C.bb == 0) joint.law.b = laws.front().law.b;
  joint.agreement = compare(laws, joint.law, static_cast<std::size_t>(C.aa > 0) + (C.bb > 0), 0);
  if (!joint.agreement.agree()) {
    take_scatter(joint, std::move(laws), common);
    return joint;
  }
  const Symmetric V = joint.covariance;
  for (const CommonError& error : common) {
    Pair share{};
    for (const std::size_t row : error.rows)
      share = share + covariances[row].inverse() * Pair{error.log_a, 0};
    joint.covariance = joint.covariance + outer_square(V * share);
  }
  return joint;
}

}  // namespace rolling
