// The running integral of a column over time by the trapezoidal rule, second order in the spacing.
#pragma once

namespace rolling {

class Integral {
 public:
  /// Takes the next sample (times increase); returns the integral from the first sample to this
  /// one. The sum is carried with its rounding error (Neumaier), so it does not drift however long
  /// the run.
  double push(double t, double y);

 private:
  bool begun_ = false;
  double t_ = 0, y_ = 0, sum_ = 0, error_ = 0;
};

}  // namespace rolling
