// The running integral of a column over time.
#pragma once

namespace rolling {

/// Each step is integrated under the parabola through its two samples and the one before (the
/// third-order rule of Adams and Moulton on uneven times): the error is of third order in the
/// spacing. The trapezoidal rule replaces it where the parabola would be wrong: for the first step,
/// for a step more than twice as long as the one before, and for a step from or to a sample of
/// exactly 0, which is rest: the power has a corner there.
class Integral {
 public:
  /// Adds the next sample (times increase) and returns the integral from the first sample to this
  /// one. The sum is compensated (Neumaier), so rounding errors do not accumulate in long runs.
  double push(double t, double y);

 private:
  int samples_ = 0;  // so far, up to 2
  double t_ = 0, y_ = 0;
  double last_step_ = 0, last_rise_ = 0;  // of t and of y over the step before
  double sum_ = 0, error_ = 0;
};

}  // namespace rolling
