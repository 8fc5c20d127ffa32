// The running integral of a column over time.
#pragma once

namespace rolling {

/// Over each step stands the parabola through its two samples and the one before (the third-order
/// rule of Adams and Moulton, on uneven times): third order in the spacing. A straight line stands
/// where a parabola has no ground: over the first step, over a step that is more than twice as long
/// as the one before, and over a step from or to a sample of exactly 0, which is rest, and where a
/// power that has been falling ends in a corner.
class Integral {
 public:
  /// Takes the next sample (times increase); returns the integral from the first sample to this
  /// one. The sum is carried with its rounding error (Neumaier), so it does not drift however long
  /// the run.
  double push(double t, double y);

 private:
  int samples_ = 0;  // so far, up to 2
  double t_ = 0, y_ = 0;
  double last_step_ = 0, last_rise_ = 0;  // of t and of y over the step before
  double sum_ = 0, error_ = 0;
};

}  // namespace rolling
