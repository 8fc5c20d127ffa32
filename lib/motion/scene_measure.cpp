// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/scene.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "base/error.h"

namespace rolling {

Reference reference(const Scene& scene, std::size_t n, double end) {
  const bool road = scene.body.road != nullptr;
  const auto motion = start(scene, best_method(scene), road ? finest : 1e-13);
  Reference result{{}, {}, road ? motion->roll()->stop_until(end) : motion->stop_time()};
  double last = scene.bulge.length > 0 ? result.stop : 1.2 * result.stop;
  if (road || result.stop > 1000 * end) last = end;
  for (std::size_t i = 0; i < n; ++i) {
    result.times.push_back(last * static_cast<double>(i) / static_cast<double>(n - 1));
    motion->seek(result.times.back());
    result.speeds.push_back(motion->velocity());
  }
  return result;
}

Measured measure(const std::function<std::unique_ptr<Motion>()>& start, const Reference& right) {
  Measured result;
  const auto [lowest, highest] = std::ranges::minmax(right.speeds);
  const double unit = std::max(-lowest, highest);
  try {
    const auto motion = start();
    for (std::size_t i = 0; i < right.times.size(); ++i) {
      motion->seek(right.times[i]);
      const double v = motion->velocity();
      if (!std::isfinite(v)) fail("v is not a number at t = {:.6g} s", right.times[i]);
      result.v_error = std::max(result.v_error, std::abs(v - right.speeds[i]) / unit);
    }
    result.evaluations = motion->evaluations();
    if (std::isfinite(right.stop) && right.stop > 0)
      result.stop_error = std::abs(motion->stop_time() / right.stop - 1);
    const std::clock_t begin = std::clock();
    const std::clock_t least = CLOCKS_PER_SEC / 50;
    std::clock_t taken = 0;
    double samples = 0;
    double sum = 0;
    do {
      const auto timed = start();
      for (const double t : right.times) {
        timed->seek(t);
        sum += timed->velocity();
        ++samples;
      }
      taken = std::clock() - begin;
    } while (taken < least);
    [[maybe_unused]] volatile const double kept = sum;  // else a compiler may drop the loop
    result.seconds = static_cast<double>(taken) / CLOCKS_PER_SEC / samples;
  } catch (const Error& error) {
    result.failure = error.what();
  }
  return result;
}

}  // namespace rolling
