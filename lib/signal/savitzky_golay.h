// Local polynomials by least squares, at any spacing: Savitzky and Golay (1964), Anal. Chem. 36,
// 1627, where times are even.
#pragma once

#include "signal/signal.h"

namespace rolling {

/// A polynomial fitted to samples, and its slope, at one time. Orthogonal polynomials (Forsythe
/// 1957, J. SIAM 5, 74) on the times about that one keep it well conditioned.
class LocalPolynomial {
 public:
  struct Point {
    double value, slope;
  };
  /// Of that order, or of one less than there are samples (at least one); `here` is the time [s]
  /// and a value near its own.
  Point operator()(std::span<const Sample>, const Sample& here, std::size_t order);

 private:
  std::vector<double> u_, rest_, p_, before_;
};

/// At the ends of a run the polynomial is that of the first or last whole window. Exact for
/// polynomials of its order.
class SavitzkyGolay : public WindowedSignal<SavitzkyGolay> {
 public:
  enum class What { value, slope };
  /// The greatest order: beyond it the recurrence of the orthogonal polynomials loses digits where
  /// the order is near the number of samples (none that matters up to 10; half of them at 30).
  static constexpr std::size_t most_order = 10;
  /// Throws Error for an even width, and for an order above that, or that a window of so many
  /// samples does not determine.
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
