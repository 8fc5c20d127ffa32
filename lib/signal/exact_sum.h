// A sum of doubles without rounding, from which terms can be taken away again: after any history of additions and
// subtractions it is what the terms still in it add up to. So a moving sum cannot drift, and an outlier leaves no trace.
#pragma once

#include <array>
#include <cstdint>

namespace rolling {

class ExactSum {
 public:
  void add(double y) { accumulate(y, 1); }
  void subtract(double y) { accumulate(y, -1); }
  /// Sum / n, within 1 ulp of the exact quotient. At most 2^30 terms; n > 0.
  double over(std::size_t n);

 private:
  void accumulate(double y, std::int64_t sign);

  // A fixed-point number of 2^-1074 in limbs of 32 bits, each with room for 2^31 terms: no carries while adding, so taking a
  // term away restores every limb (after Kulisch's long accumulator).
  static constexpr std::size_t limbs = 68;
  std::array<std::int64_t, limbs> limb_{};
  std::size_t low_ = limbs, high_ = 0;  // limbs outside [low_, high_) are 0
};

}  // namespace rolling
