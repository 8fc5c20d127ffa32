// SPDX-License-Identifier: GPL-3.0-or-later
// The closed form in 80 decimal digits, for the numbers given as doubles.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cmath>
#include <limits>

#include "contact/body.h"
#include "law/law.h"

namespace rolling {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<80>,
                                           boost::multiprecision::et_off>;

struct ClosedFormReference {
  Real v, x, a;
};

inline ClosedFormReference closed_form_reference(const Body& c, PowerLaw law, double v0, double t) {
  const Real s = 1 - Real(law.b),
             rate = Real(law.a) * c.g / ((Real(c.K) + 1) * c.R) * pow(Real(v0), -s);
  const Real q = rate * t, w = 1 - s * q;
  if (s > 0 && w <= 0) return {0, v0 / (rate * (1 + s)), 0};
  const Real lambda = s == 0 ? q : Real(-log(w) / s), v = v0 * exp(-lambda);
  const Real x =
      s == -1 ? Real(v0 / rate * lambda) : Real(v0 / rate * (1 - exp(-(1 + s) * lambda)) / (1 + s));
  return {v, x, -rate * v0 * exp(-law.b * lambda)};
}

/// |value - exact| in units of the last place of the exact value.
inline double ulp_error(double value, const Real& exact) {
  const double nearest = std::abs(static_cast<double>(exact)),
               ulp = std::nextafter(nearest, std::numeric_limits<double>::infinity()) - nearest;
  return static_cast<double>(abs(Real(value) - exact) / ulp);
}

}  // namespace rolling
