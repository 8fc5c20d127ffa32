// SPDX-License-Identifier: GPL-3.0-or-later
// Fits in which outliers count little or nothing.
#pragma once

#include "least_squares/minimise.h"

namespace rolling {

/// Minimises Tukey's bisquare loss (constant 4.685: 95 % efficiency for normal noise) by
/// iteratively reweighted least squares, starting from the minimum of Huber's loss (1.345, the same
/// efficiency). The scale of each run is the median size of its residuals in the latter: the loss
/// is the sum of s^2 rho(f/s), with the s of the run, and without outliers that of plain squares.
/// Of a run of at most 1000 residuals and 12 parameters, outliers of the least trimmed squares
/// do not count in Huber's loss: few outliers could draw its minimum to them. The f of the result
/// are pseudo-residuals (Huber 1981, Robust Statistics, section 7.6) and R is unweighted, so that
/// the least-squares formulas for the errors, applied to them, give the errors of the robust fit.
/// The residuals must be those of single rows, with independent noise.
/// The search of longer runs begins at the first start.
Minimum minimise_robust(const System&, const std::vector<std::vector<double>>& starts);

}  // namespace rolling
