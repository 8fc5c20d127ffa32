// SPDX-License-Identifier: GPL-3.0-or-later
// Local polynomials by least squares at any spacing; at even times the filter of Savitzky and Golay
// (1964, Anal. Chem. 36, 1627).
#pragma once

#include "signal/signal.h"

namespace rolling {

/// The value and the slope, at one time, of the least-squares polynomial through samples.
/// Orthogonal polynomials (Forsythe 1957, J. SIAM 5, 74) in the time relative to that one keep the
/// problem well conditioned.
class LocalPolynomial {
 public:
  struct Point {
    double value, slope;
  };
  /// The order is reduced to the number of samples (at least one) minus one where necessary. `here`
  /// holds the time of evaluation [s] and a value close to the readings, which is subtracted first.
  Point operator()(std::span<const Sample>, const Sample& here, std::size_t order);

 private:
  std::vector<double> u_, rest_, p_, before_;
};

/// The filter: exact for polynomials of its order. At the ends of a run it evaluates the polynomial
/// of the first or last complete window.
class SavitzkyGolay : public WindowedSignal<SavitzkyGolay> {
 public:
  enum class What { value, slope };
  /// The highest order. The recurrence of the orthogonal polynomials loses digits if the order is
  /// close to the number of samples: no relevant ones up to order 10, half of them at 30.
  static constexpr std::size_t most_order = 10;
  /// Throws Error for an even width, an order above most_order, and an order that needs more
  /// samples than the width has.
  SavitzkyGolay(Width, std::size_t order, What);
  /// Throws Error for the slope in a window of one sample.
  double value(const Windows&);

 private:
  std::size_t order_;
  What what_;
  LocalPolynomial polynomial_;
  std::vector<Sample> samples_;
};

}  // namespace rolling
