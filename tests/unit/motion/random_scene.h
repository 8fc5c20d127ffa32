// SPDX-License-Identifier: GPL-3.0-or-later
// Random scenes and times to compare the closed form and the exact geometry on.
#pragma once

#include <cmath>
#include <random>

#include "contact/body.h"
#include "law/law.h"

namespace rolling {

struct RandomScene {
  Body body;
  PowerLaw law;
  double v0;
};

/// a 1e-5 .. 1e-2, b 0 .. 2.5 and within 1e-15 of 1, K 0 .. 1, R 0.01 .. 0.5, v0 0.01 .. 10, such
/// that D(v0) < R.
inline RandomScene random_scene(std::mt19937_64& random) {
  const auto between = [&](double lo, double hi) {
    return std::uniform_real_distribution(lo, hi)(random);
  };
  for (;;) {
    const double b = between(0, 4) < 1 ? 1 + between(-1e-15, 1e-15) : between(0, 2.5),
                 v0 = std::pow(10, between(-2, 1));
    const RandomScene scene{
        {1, between(0.01, 0.5), between(0, 1)}, {std::pow(10, between(-5, -2)), b}, v0};
    if (scene.law(v0) < scene.body.R) return scene;
  }
}

/// A time before the stop: for i = 0 at t*(1 - 1e-9), for i = 1 near it, else anywhere; without a
/// stop over eleven decades.
inline double random_time(std::mt19937_64& random, const RandomScene& s, double stop, int i) {
  const auto between = [&](double lo, double hi) {
    return std::uniform_real_distribution(lo, hi)(random);
  };
  const double unit = s.v0 / (s.law(s.v0) * s.body.g / ((s.body.K + 1) * s.body.R));
  if (stop > 1e3 * unit) return unit * std::pow(10, between(-8, 3));
  return stop * (i == 0 ? 1 - 1e-9 : i == 1 ? 1 - std::pow(10, between(-9, 0)) : between(0, 1));
}

/// Changes a so that D(v0) is part of R.
inline void deepen(RandomScene& scene, double part) {
  scene.law.a = part * scene.body.R * std::pow(scene.v0, -scene.law.b);
}

/// One with D(v0) near R: 1 - D/R from 0.5 to 1e-15, a third with D the largest double below R;
/// some with K = 0, some with b near 1 or 0.
inline RandomScene deep_scene(std::mt19937_64& random, int n) {
  const auto between = [&](double lo, double hi) {
    return std::uniform_real_distribution(lo, hi)(random);
  };
  RandomScene scene = random_scene(random);
  if (n % 5 == 0) scene.body.K = 0;
  if (n % 4 == 0) scene.law.b = 1 + std::copysign(std::pow(10, between(-15, -2)), between(-1, 1));
  if (n % 4 == 1) scene.law.b = std::pow(10, between(-6, -1));
  deepen(scene, n % 3 == 0 ? 1 : 1 - std::pow(10, between(-15, -0.3)));
  while (scene.law(scene.v0) >= scene.body.R) scene.law.a = std::nextafter(scene.law.a, 0);
  return scene;
}

}  // namespace rolling
