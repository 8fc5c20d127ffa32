// The time derivative of a column, one sample in at a time.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace rolling {

/// Of the parabola through three neighbouring samples at any spacing: at the middle one inside (the central difference),
/// at the outer one at the ends. Second order in the spacing, exact on a parabola. A run of two samples has their slope.
class CentralDerivative {
 public:
  /// Takes the next sample (times increase); returns the derivatives that are now known, in order. Valid until the next call.
  std::span<const double> push(double t, double y);
  /// The run has ended: the derivatives still owed. Throws Error for a run of one sample.
  std::span<const double> finish();

 private:
  std::size_t count_ = 0;
  double t_ = 0, y_ = 0;          // the last sample
  double step_ = 0, slope_ = 0;   // from the one before it
  double bend_ = 0;               // half of the parabola's second derivative
  std::array<double, 2> known_{};
};

}  // namespace rolling
