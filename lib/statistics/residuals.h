// SPDX-License-Identifier: GPL-3.0-or-later
// Are the residuals of several runs white and even, and what do they add up to if they are not?
// The residuals of all runs follow each other; `runs` holds the number of each run.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/matrix.h"

namespace rolling {

/// The sums of the products of numbers that are 0, 1, 2, ... rows apart.
using LagSums = std::array<double, 11>;

/// The bias of these sums for the residuals (I - Q Q^T) e of a fit, with white noise e of variance
/// one: the fit lowers them by the sums of the products of the rows of Q. Q has orthonormal
/// columns: those that belong to the parameters of the run of a row and to the shared ones.
LagSums taken_by(const Matrix& Q, std::span<const std::size_t> runs);
/// The limit for runs that are much longer than the lags, of p parameters in all.
LagSums taken_by_few(std::size_t p);

/// The p of the autocorrelation of the residuals of a fit, after Ljung and Box (1978,
/// Biometrika 65, 297). Two sums are tested: that for one lag and that for n/10 lags (at least 1,
/// at most 10). The p is the probability that white noise makes the smaller of their two
/// probabilities as small as it is, so that it is uniform for white noise. Corrected for what the
/// fit has taken. The noise of each run has its own variance; where it is `uneven` along a run,
/// too, the variance of each sum of products is the sum of their squares (Lobato, Nankervis and
/// Savin 2001, Int. Econ. Rev. 42, 187).
double ljung_box(std::span<const double> residuals, const LagSums&,
                 std::span<const std::size_t> runs, bool uneven = false);

/// The p of a variance that differs between the runs, or that has a trend along them, linear and
/// quadratic in the row number: the studentised test of Breusch and Pagan (Koenker 1981,
/// J. Econometrics 17, 107). `left` is the share that a fit has left of the variance of each
/// residual; without it all of it.
double breusch_pagan(std::span<const double> residuals, std::span<const std::size_t> runs,
                     std::span<const double> left = {});

/// The sum of the products of residuals that are `lag` rows apart within a run.
double lagged(std::span<const double> residuals, std::span<const std::size_t> runs,
              std::size_t lag);

/// AR of the noise e_i = AR e_(i-1) + white noise behind the residuals of a fit of p smooth terms,
/// which lowers their correlation with their neighbours by (p (1 + AR) + 2 AR)/n (Kendall 1954,
/// Biometrika 41, 403, for p = 1). At most 0.97.
double autoregression(std::span<const double> residuals, std::size_t p,
                      std::span<const std::size_t> runs);

/// The meat of the sandwich, the sum of w(|i-j|) u_i u_j^T over each run, row by row, run by run.
/// The rows of `scores` are the u_i; p is the number of degrees of freedom that the fit and the
/// filters have taken from the noise. The weights w are Bartlett's
/// (Newey and West 1987, Econometrica 55, 703) with the bandwidth of Andrews' AR(1) rule (1991,
/// Econometrica 59, 817), after prewhitening by the AR(1) of the residuals (Andrews and Monahan
/// 1992, Econometrica 60, 953). Short rows need prewhitening.
std::vector<double> newey_west(Matrix scores, std::size_t p, std::vector<double> residuals,
                               std::span<const std::size_t> runs);

}  // namespace rolling
