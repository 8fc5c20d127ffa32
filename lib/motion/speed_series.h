// The integrals over speed of D(v) = a v^b in the exact geometry, by the binomial series of A.
#pragma once

#include <vector>

#include "motion/speed_arm.h"
#include "motion/wanted.h"

namespace rolling {

/// The range ln(v0/u) > from. Where z <= 1/4 there and b > 0, the binomial series of A and 1/A in
/// powers of z make every integral a sum of power_integral() with at most 30 terms. Where A is
/// constant (depth = 0 or b = 0) the sum has one term.
///
/// Here y counts from the beginning of the range, and the speed there is the unit of speed: the
/// integrals are those of a roll that begins there. s = 1 - b; y = infinity is the stop, for s > 0.
class SpeedSeries {
 public:
  /// The binomial series. z must be at most 1/4 from `from` on.
  static SpeedSeries binomial(const SpeedArm&, double from);
  /// The single term for constant A.
  static SpeedSeries constant(const SpeedArm&);

  double time(double y) const;      ///< int_0^y f e^(-s u) du
  double lag(double y) const;       ///< int_0^y (1 - f) e^(-s u) du
  double lag_rest(double y) const;  ///< int_y^infinity (1 - f) e^(-s u) du, for s > 0
  double distance(double y) const;  ///< int_0^y f e^(-(s+1) u) du
  SpeedGradient gradient(double y, Wanted) const;
  /// y with time(y) = time. `rest` is time(infinity) - time from a caller who may know it without
  /// cancellation, infinite for s <= 0.
  double lambda(double time, double rest) const;

  std::size_t terms() const { return terms_.size(); }

 private:
  /// f e^(-(1-b) u) is the sum of f e^(-s u) over the terms; so are 1 - f with lag, and h with h.
  struct Term {
    double s, f, lag, h;
    double f_by_s = f / s, lag_by_s = lag / s;
  };
  SpeedSeries(const SpeedArm& arm, double from) : arm_(arm), from_(from) {}
  double lambda_of_rest(double rest) const;

  SpeedArm arm_;
  double from_;
  std::vector<Term> terms_;
};

}  // namespace rolling
