// SPDX-License-Identifier: GPL-3.0-or-later
// The laws D = a v^b of several runs, each with the covariance of its own fit: do they agree, what
// is their mean where they do not, and what is their joint law?
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "base/estimate.h"
#include "statistics/levels.h"
#include "statistics/random_effects.h"

namespace rolling {

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
  /// A parameter that is fixed has a row and a column of zeros; they stay zeros.
  Symmetric inverse() const {
    const auto of_one = [](double variance) { return variance == 0 ? 0 : 1 / variance; };
    if (aa == 0 || bb == 0) return {of_one(aa), 0, of_one(bb)};
    const double det = aa * bb - ab * ab;
    return {bb / det, -ab / det, aa / det};
  }
  bool is_finite() const { return std::isfinite(aa) && std::isfinite(ab) && std::isfinite(bb); }
  /// True if no variance is negative; a parameter that is fixed has none.
  bool is_positive() const { return aa >= 0 && bb >= 0 && aa * bb >= ab * ab; }
};
inline Symmetric outer_square(Pair x) { return {x.a * x.a, x.a * x.b, x.b * x.b}; }
inline Pair operator+(Pair x, Pair y) { return {x.a + y.a, x.b + y.b}; }
inline Pair operator-(Pair x, Pair y) { return {x.a - y.a, x.b - y.b}; }
inline Symmetric operator+(Symmetric X, Symmetric Y) {
  return {X.aa + Y.aa, X.ab + Y.ab, X.bb + Y.bb};
}
inline Symmetric operator-(Symmetric X, Symmetric Y) {
  return {X.aa - Y.aa, X.ab - Y.ab, X.bb - Y.bb};
}
inline Pair operator*(double s, Pair x) { return {s * x.a, s * x.b}; }
/// The same law in the unit of speed exp(log_v): ln D there in the place of ln a.
inline Pair in_unit(Pair law, double log_v) { return {law.a + log_v * law.b, law.b}; }
inline Symmetric operator*(double s, Symmetric X) { return {s * X.aa, s * X.ab, s * X.bb}; }

/// The degrees of freedom of errors that are known.
inline constexpr double known_errors = 1e6;

/// The law of one run that is fitted by itself, with the errors of the noise.
struct OwnLaw {
  std::size_t run;
  Pair law;
  Symmetric covariance;
  double freedom;  ///< degrees of freedom of its residuals; of many, about known_errors, where they
                   ///< are not known
  double rms = 0;  ///< of its residuals, by which the noise of runs is compared; 0 where that is
                   ///< not known

  /// The logarithm of D at the speed exp(log_v), with its standard error.
  Estimate log_D(double log_v) const;
  /// The logarithm of the speed at which the error of D is least; D and b are uncorrelated there.
  double best_log_v() const { return covariance.bb > 0 ? -covariance.ab / covariance.bb : 0; }
  Estimate b() const { return {law.b, std::sqrt(covariance.bb)}; }
};

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

/// The comparison of runs, each fitted by its own law, and the run that differs most from the
/// others.
struct Agreement {
  double chi2 = 0;  ///< chi-square of the differences of the laws; its expected value is dof
  std::size_t dof = 0;
  /// -2 ln of the ratio of likelihoods of one common law to laws of the runs' own, which is chi2
  /// but for what the noise of each run, an estimate, adds to that.
  double ratio = 0;
  double p = 1;          ///< the probability that noise alone makes `ratio` as large
  std::size_t runs = 0;  ///< the number of runs that determine a law
  std::size_t run = 0;   ///< the run that differs most from the others, from 0
  /// The probability that noise alone puts any of the runs so far from the others: that of one run,
  /// by Fisher's F, times the number of runs (Bonferroni). One bad run among many is found by it; a
  /// chi-square of all hides it.
  double p_of_run = 1;
  double speed = 1;      ///< the speed at which D of that run is known best [m/s]
  Estimate log_D = {};   ///< ln D of that run minus ln D of the others at that speed
  Estimate b = {};       ///< the exponent of that run minus the exponent of the others
  bool of_mean = false;  ///< the law of the row is the mean of the runs' own

  bool agree() const { return p > levels::runs_disagree; }
};

/// -2 ln of the ratio of likelihoods, of the common law to the own law of a run whose noise has a
/// size of its own that is an estimate: c ln(1 + d/nu), with the squared distance d of the two laws
/// and the degrees of freedom nu of the noise. The factor c makes its mean `parameters`.
double ratio_of_run(double distance, double freedom, std::size_t parameters);

/// The probability that noise alone puts the law of a run so far from the others, by Fisher's F.
double p_of_run(double distance, double freedom, std::size_t parameters);

/// Compares two or more laws. `parameters`: how many of a and b are free; `taken` degrees of
/// freedom were spent on what the runs have in common beside the law. No D is told at a speed above
/// `fastest`.
Agreement compare(const std::vector<OwnLaw>&, std::size_t parameters, std::size_t taken,
                  double fastest = INFINITY);

/// The logarithm of the speed that is common to laws which are known best at the speeds `log_v_of`.
double common_log_v(const std::vector<OwnLaw>&,
                    const std::function<double(const OwnLaw&)>& log_v_of);

/// What an error that laws have in common, as that of the shape factor of their body, brings to ln
/// a and b of each.
using CommonError = std::vector<Pair>;

struct JointLaw {
  Pair law;              ///< ln a and b
  Symmetric covariance;  ///< common errors included
  Agreement agreement = {};
  double scatter_log_a = 0, scatter_b = 0;  ///< standard deviations beyond the noise
};

/// The mean law of runs that scatter: that of the mean of b and of the mean of ln D at the speed
/// exp(log_v), where both scatter independently (random_effects.h). The scatter of a itself, which
/// is D at 1 m/s, is that of b if the runs are slower, and would depend on the unit of speed.
JointLaw scattered_mean(const std::vector<OwnLaw>&, double log_v, double freedom,
                        const std::vector<CommonError>&);

/// The joint law of runs, as agreement_of() makes it of their readings. Runs that agree have the
/// mean weighted by their inverse covariances; if the noise of all is of one size (Bartlett 1937 at
/// 1 %), that size is the common one, as in a joint fit. Runs that do not agree have the
/// scattered_mean(). Two or more runs, all with the same of a and b free.
JointLaw joint_law(const std::vector<OwnLaw>&, const std::vector<CommonError>&);

}  // namespace rolling
