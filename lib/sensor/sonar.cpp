// SPDX-License-Identifier: GPL-3.0-or-later
#include "sensor/sonar.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/error.h"
#include "base/gsl.h"

namespace rolling {

namespace {

/// x to the nearest multiple of the resolution; divided by 1000 rather than multiplied by 0.001,
/// which is not 1/1000.
double rounded(double x, double resolution) {
  if (resolution == 0) return x;
  const double per_metre = std::round(1 / resolution);
  if (std::abs(per_metre * resolution - 1) < 1e-12) return std::round(x * per_metre) / per_metre;
  return std::round(x / resolution) * resolution;
}

}  // namespace

void sonar_run(Motion& motion, const SonarOptions& o,
               const std::function<void(const SonarSample&)>& write) {
  motion.seek(0);
  const double v0 = motion.velocity();
  const double x0 = motion.position();
  const double roll = std::isinf(o.until) ? motion.stop_time() + o.rest_after : o.until;
  const double release = o.rest_before + o.push;
  const double rows = std::floor((release + roll) * o.rate * (1 + 1e-12)) + 1;
  if (!(rows >= 1 && rows <= 1e9)) fail("the sensor would make {:.3g} rows, not 1 to 1e9", rows);

  const auto way = [&](double t) -> double {
    if (t <= o.rest_before) return 0;
    if (t < release) {  // v = v0 sin^2(pi u / (2 push)), u the time since the hand took hold
      const double u = t - o.rest_before;
      return v0 / 2 * (u - o.push / std::numbers::pi * std::sin(std::numbers::pi * u / o.push));
    }
    motion.seek(t - release);
    return v0 / 2 * o.push + (motion.position() - x0);
  };
  const auto distance = [&](double t) {
    if (!o.towards) return o.start + way(t);
    return o.start + v0 / 2 * o.push + *o.towards - way(t);
  };

  silence_gsl();
  const auto random = own(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free);
  gsl_rng_set(random.get(), o.seed);
  // Rows i - 4 to i, each at its number modulo 5; the middle one has its four neighbours.
  std::array<SonarSample, 5> last;
  const auto nth = [&](std::size_t i) -> SonarSample& { return last[i % last.size()]; };
  const auto n = static_cast<std::size_t>(rows);
  for (std::size_t i = 0; i < n + 2; ++i) {
    if (i < n) {
      SonarSample& now = nth(i);
      now = {static_cast<double>(i) / o.rate, {}, {}};
      const double x = distance(now.t) + gsl_ran_gaussian_ziggurat(random.get(), o.noise);
      if (gsl_rng_uniform(random.get()) >= o.lost) now.x = rounded(x, o.resolution);
    }
    if (i < 2) continue;
    if (i >= 4 && i < n) {
      const auto& b2 = nth(i - 4).x;
      const auto& b1 = nth(i - 3).x;
      const auto& f1 = nth(i - 1).x;
      const auto& f2 = nth(i).x;
      if (b2 && b1 && f1 && f2)
        nth(i - 2).v =
            rounded((*f1 + *f2 - *b1 - *b2) * o.rate / 6, o.resolution / 10) + 0.0;  // no -0
    }
    if (i - 2 < n) write(nth(i - 2));
  }
}

}  // namespace rolling
