// SPDX-License-Identifier: GPL-3.0-or-later
// Least trimmed squares: where a robust fit may start, so that outliers do not draw it away.
#pragma once

#include "least_squares/system.h"

namespace rolling {

struct Residuals {
  std::vector<double> f;
  /// The root of the mean square of the scales of the runs: of the median size of the residuals of
  /// a run, divided by that of a standard normal variable (0.6745). So a run of much noise is no
  /// outlier as a whole. A scale of its own would be known to a fifth for a run of 30 rows, and
  /// few rows that outliers have drawn away would take them for their noise. Runs without
  /// noise, as at rest, do not count.
  double scale;
};
/// Throws Error if the model has no finite values at theta.
Residuals residuals_at(const System&, const std::vector<double>& theta);

/// The theta with the smallest scale of all that steps of least trimmed squares reach from these
/// starts. Least trimmed squares fit half of the rows of each run, those that they fit best
/// (Rousseeuw 1984, J. Am. Stat. Assoc. 79, 871). The cost grows with the cube of the number of
/// parameters. Throws Error if the model has no finite values at any of the starts.
std::vector<double> least_trimmed(const System&, const std::vector<std::vector<double>>& starts);

}  // namespace rolling
