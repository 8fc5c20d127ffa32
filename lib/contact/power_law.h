// The constitutive law D(v) = a v^b of a mat. It is odd in v, since the mat is the same in both
// directions.
#pragma once

#include <cmath>

namespace rolling {

struct PowerLaw {
  double a;  ///< shift at 1 m/s [m (s/m)^b]
  double b;  ///< exponent

  /// Shift D [m] at the velocity v [m/s]: it has the sign of v and is 0 at rest.
  double operator()(double v) const {
    return v == 0 ? 0 : std::copysign(a * std::pow(std::abs(v), b), v);
  }
};

}  // namespace rolling
