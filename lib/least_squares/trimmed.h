// Least trimmed squares: where a robust fit may start, so that outliers do not draw it away.
#pragma once

#include "least_squares/system.h"

namespace rolling {

/// The scale of residuals: their median size, divided by that of a standard normal variable
/// (0.6745). The p smallest are not counted: the p parameters may have made as many vanish.
double median_scale(std::vector<double> residuals, std::size_t p);

/// The theta with the smallest median_scale() of all that steps of least trimmed squares reach from
/// these starts. Least trimmed squares fit half of the records, those that they fit best
/// (Rousseeuw 1984, J. Am. Stat. Assoc. 79, 871). The cost grows with the cube of the number of
/// parameters. Throws Error if the model has no finite values at any of the starts.
std::vector<double> least_trimmed(const System&, const std::vector<std::vector<double>>& starts);

}  // namespace rolling
