// The closed form in 80 decimal digits, for the numbers given as doubles; and random scenes to compare it on.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cmath>
#include <limits>
#include <random>

#include "rolling/body.h"
#include "rolling/power_law.h"

namespace rolling {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<80>, boost::multiprecision::et_off>;

struct ClosedFormReference {
  Real v, x, a;
};

inline ClosedFormReference closed_form_reference(const Body& c, PowerLaw law, double v0, double t) {
  const Real s = 1 - Real(law.b), rate = Real(law.a) * c.g / ((Real(c.K) + 1) * c.R) * pow(Real(v0), -s);
  const Real q = rate * t, w = 1 - s * q;
  if (s > 0 && w <= 0) return {0, v0 / (rate * (1 + s)), 0};
  const Real lambda = s == 0 ? q : Real(-log(w) / s), v = v0 * exp(-lambda);
  const Real x = s == -1 ? Real(v0 / rate * lambda) : Real(v0 / rate * (1 - exp(-(1 + s) * lambda)) / (1 + s));
  return {v, x, -rate * v0 * exp(-law.b * lambda)};
}

/// |value - exact| in units of the last place of the exact value.
inline double ulp_error(double value, const Real& exact) {
  const double nearest = std::abs(static_cast<double>(exact)), ulp = std::nextafter(nearest, std::numeric_limits<double>::infinity()) - nearest;
  return static_cast<double>(abs(Real(value) - exact) / ulp);
}

struct RandomScene {
  Body body;
  PowerLaw law;
  double v0;
};

/// a 1e-5 .. 1e-2, b 0 .. 2.5 and within 1e-15 of 1, K 0 .. 1, R 0.01 .. 0.5, v0 0.01 .. 10, such that D(v0) < R.
inline RandomScene random_scene(std::mt19937_64& random) {
  const auto between = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
  for (;;) {
    const double b = between(0, 4) < 1 ? 1 + between(-1e-15, 1e-15) : between(0, 2.5), v0 = std::pow(10, between(-2, 1));
    const RandomScene scene{{1, between(0.01, 0.5), between(0, 1)}, {std::pow(10, between(-5, -2)), b}, v0};
    if (scene.law(v0) < scene.body.R) return scene;
  }
}

/// A time before the stop: for i = 0 at t*(1 - 1e-9), for i = 1 near it, else anywhere; without a stop over eleven decades.
inline double random_time(std::mt19937_64& random, const RandomScene& s, double stop, int i) {
  const auto between = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
  const double unit = s.v0 / (s.law(s.v0) * s.body.g / ((s.body.K + 1) * s.body.R));
  if (stop > 1e3 * unit) return unit * std::pow(10, between(-8, 3));
  return stop * (i == 0 ? 1 - 1e-9 : i == 1 ? 1 - std::pow(10, between(-9, 0)) : between(0, 1));
}

}  // namespace rolling
