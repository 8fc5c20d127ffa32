// SPDX-License-Identifier: GPL-3.0-or-later
// The mean of numbers from several runs, and a line through them, where the runs scatter by more
// than their standard errors (a random-effects model): each number has the variance sigma^2 + tau^2
// with its own sigma and one tau, and the weight 1/(sigma^2 + tau^2). tau is the one for which
// chi^2 equals its degrees of freedom, or 0 where chi^2 is not above them (Mandel and Paule 1970,
// Anal. Chem. 42, 1194).
#pragma once

#include <vector>

#include "base/estimate.h"

namespace rolling {

/// The line x = mean + slope (g - mean_g) through numbers x of the runs.
struct RandomEffectsLine {
  double tau_square = 0;
  double mean = 0, mean_g = 0;
  double slope = 0;               ///< 0 if g is the same in all runs
  double weight = 0, spread = 0;  ///< sum of w, and of w (g - mean_g)^2
  double chi2 = 0;                ///< sum of w r^2 of the residuals r
  double fall = 0;                ///< -d chi2/d tau^2

  double weight_of(const Estimate& x) const { return 1 / (x.sigma * x.sigma + tau_square); }
};
/// `freedom`: the degrees of freedom of chi^2, above 0. A number with sigma = 0 makes the weight
/// infinite where all numbers are equal, and the other fields NaN.
RandomEffectsLine random_effects_line(const std::vector<Estimate>& x, const std::vector<double>& g,
                                      double freedom);

/// The quotient of Student's quantile of 0.975 by 1.96: an error with so few degrees of freedom,
/// multiplied by it, holds the truth in 95 % within 1.96 times its size.
double student(double freedom);

/// The weighted mean of numbers of the runs, and its error from the distances of the runs to each
/// other alone: a run with the share h of the weights and the residual r contributes h r/sqrt(1 -
/// h) (HC2), and the error is the root of the sum of their squares times student(). The degrees of
/// freedom of that sum are those of Satterthwaite for numbers that scatter as the weights say: N -
/// 1 if the weights are equal, and down to 1 if one run has them all (Bell and McCaffrey 2002,
/// Survey Methodology 28, 169; Imbens and Kolesar 2016, Rev. Econ. Stat. 98, 701). The root of
/// 1/sum(weights) would not do: where one run is more precise than the others, few runs tell tau
/// too roughly. Numbers that are equal without errors, as those of a fixed parameter, are their own
/// mean, without shares.
struct RandomEffectsMean {
  double value, tau_square;
  std::vector<double> shares;  ///< of the runs in the weights
  std::vector<double> parts;   ///< of the runs in the error, with their signs
};
/// Two or more numbers; `freedom` as in random_effects_line().
RandomEffectsMean random_effects_mean(const std::vector<Estimate>& x, double freedom);

}  // namespace rolling
