// SPDX-License-Identifier: GPL-3.0-or-later
// Exact arithmetic on doubles, to judge sums and means by: a number as doubles that do not overlap,
// after J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
// Predicates (1997). Not the method of lib/signal.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace rolling {

/// Sum of doubles without rounding, as long as nothing overflows.
class Expansion {
 public:
  void add(double y) {
    std::vector<double> grown;
    for (const double part : parts_) {
      const double sum = y + part, of_part = sum - y;
      const double error = (y - (sum - of_part)) + (part - of_part);
      if (error != 0) grown.push_back(error);
      y = sum;
    }
    if (y != 0) grown.push_back(y);
    parts_ = std::move(grown);
  }
  /// Adds n y, exact if no part of it is below the range of a double.
  void add_product(double n, double y) {
    const double product = n * y;
    add(product);
    add(std::fma(n, y, -product));
  }
  int sign() const { return parts_.empty() ? 0 : parts_.back() > 0 ? 1 : -1; }
  double nearly() const {
    double sum = 0;
    for (const double part : parts_) sum += part;
    return sum;
  }

 private:
  std::vector<double> parts_;  // the smallest first
};

/// Is `mean` within one ulp of the exact mean of `values`? `scale` is a power of two that keeps
/// them all within range.
inline bool within_one_ulp(std::span<const double> values, double mean, double scale = 1) {
  const double up = std::nextafter(mean, std::numeric_limits<double>::infinity());
  const double down = std::nextafter(mean, -std::numeric_limits<double>::infinity());
  const auto side = [&](double bound) {  // sign of sum - n bound
    Expansion difference;
    for (const double y : values) difference.add(y * scale);
    difference.add_product(-static_cast<double>(values.size()), bound * scale);
    return difference.sign();
  };
  return std::isfinite(mean) && side(up) <= 0 && side(down) >= 0;
}

}  // namespace rolling
