// Least trimmed squares: where a robust fit may start, so that outliers do not draw it away.
#pragma once

#include "least_squares/system.h"

namespace rolling {

struct Residuals {
  std::vector<double> f;
  /// The median size of the residuals of each run, divided by that of a standard normal variable
  /// (0.6745). A run most of whose residuals are 0, as at rest, has that of all.
  std::vector<double> scales;
  double scale;  ///< the root of the mean square, over the records, of the scales of their runs
};
/// Throws Error if the model has no finite values at theta.
Residuals residuals_at(const System&, const std::vector<double>& theta);

/// The theta with the smallest scale of all that steps of least trimmed squares reach from these
/// starts. Least trimmed squares fit half of the records of each run, those that they fit best
/// (Rousseeuw 1984, J. Am. Stat. Assoc. 79, 871). The cost grows with the cube of the number of
/// parameters. Throws Error if the model has no finite values at any of the starts.
std::vector<double> least_trimmed(const System&, const std::vector<std::vector<double>>& starts);

}  // namespace rolling
