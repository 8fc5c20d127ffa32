// The constitutive law D(v) = a v^b of a mat, odd in v: the mat does not know left from right.
#pragma once

#include <cmath>

namespace rolling {

struct PowerLaw {
  double a;  ///< shift at 1 m/s [m (s/m)^b]
  double b;  ///< exponent

  /// Shift D [m] ahead of the lowest point at speed v [m/s]: it points along the motion, and is 0
  /// at rest.
  double operator()(double v) const {
    return v == 0 ? 0 : std::copysign(a * std::pow(std::abs(v), b), v);
  }
};

}  // namespace rolling
