// SPDX-License-Identifier: GPL-3.0-or-later
// Nonlinear least squares to the limit of rounding: Levenberg-Marquardt steps, then Gauss-Newton
// steps. Each step comes from a QR decomposition of the Jacobian.
#pragma once

#include <limits>

#include "least_squares/system.h"
#include "least_squares/triangles.h"

namespace rolling {

/// The way out of data that no law fits.
inline constexpr const char* choose_the_roll =
    "are all of these rows of one free roll that slows down (up a slope and back: --slope fit)? "
    "Choose it with smooth --coast, or with --from and --to";

/// The residuals f at theta, and J = Q R there. R and not J^T J, because the condition number of
/// the normal equations is the square of that of J.
struct Minimum {
  std::vector<double> theta, f = {};
  Triangles R = {};
  double rss = std::numeric_limits<double>::infinity();  ///< |f|^2
};

/// The minimum that the search finds from `start`. Throws Error if the search does not converge or
/// if the Jacobian is rank-deficient.
Minimum minimise(const System&, const std::vector<double>& start);

/// The same for one start of several, or for a smaller system that approximates the one to be
/// solved: if the search finds no minimum, theta is `start`, rss is infinite and the rest is empty.
Minimum attempt(const System&, const std::vector<double>& start);

/// f and R at theta, which need not be a minimum; rss is infinite, and the rest empty, where the
/// model has no finite values.
Minimum tried(const System&, std::vector<double> theta);

/// The same; throws Error where the model has no finite values.
Minimum evaluated(const System&, std::vector<double> theta);

/// theta + step.
std::vector<double> moved(std::vector<double> theta, const std::vector<double>& step);

/// ln of the restricted likelihood (Patterson and Thompson 1971, Biometrika 58, 545) of normal
/// white residuals, up to a constant, with the model linear around theta: -(n - p)/2 ln RSS - ln
/// |det R|.
double restricted_likelihood(const Minimum& at);

}  // namespace rolling
