// SPDX-License-Identifier: GPL-3.0-or-later
// Local polynomials by least squares at any spacing; at even times the filter of Savitzky and Golay
// (1964, Anal. Chem. 36, 1627).
#pragma once

#include "signal/signal.h"

namespace rolling {

/// The highest order. The recurrence of the orthogonal polynomials loses digits if the order is
/// close to the number of samples: no relevant ones up to order 10, half of them at 30.
inline constexpr std::size_t most_order = 10;

/// The filter: exact for polynomials of its order. At the ends of a run it evaluates the polynomial
/// of the first or last complete window. Its output is the derivative 0 or 1 of the polynomial, its
/// value or its slope. Throws Error for an even width, an order above most_order, and an order that
/// needs more samples than the width has; and, while it filters, for the slope in a window of one
/// sample.
std::unique_ptr<Signal> savitzky_golay(Width, std::size_t order, std::size_t derivative);

}  // namespace rolling
