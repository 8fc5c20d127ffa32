// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/measure.h"

#include <time.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace rolling {

namespace {

/// The processor time of this thread [s], which other processes do not affect.
double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

Reference reference(const Scene& scene, std::size_t n, double end) {
  const auto motion = start(scene, best_method(scene), 1e-13);
  Reference result{{}, {}, motion->stop_time()};
  const double last = result.stop > 1000 * end ? end
                      : scene.bulge.length > 0 ? result.stop
                                               : 1.2 * result.stop;
  for (std::size_t i = 0; i < n; ++i) {
    result.times.push_back(last * static_cast<double>(i) / static_cast<double>(n - 1));
    motion->seek(result.times.back());
    result.speeds.push_back(motion->velocity());
  }
  return result;
}

Measured measure(const std::function<std::unique_ptr<Motion>()>& start, const Reference& right,
                 double v0, int repeats) {
  Measured result;
  try {
    const auto motion = start();
    for (std::size_t i = 0; i < right.times.size(); ++i) {
      motion->seek(right.times[i]);
      const double v = motion->velocity();
      if (!std::isfinite(v)) fail("v is not a number at t = {:.6g} s", right.times[i]);
      result.v_error = std::max(result.v_error, std::abs(v - right.speeds[i]) / v0);
    }
    result.evaluations = motion->evaluations();
    if (std::isfinite(right.stop))
      result.stop_error = std::abs(motion->stop_time() / right.stop - 1);
    std::vector<double> seconds;
    for (int i = 0; i < repeats; ++i) {
      const double begin = processor_time();
      const auto timed = start();
      double sum = 0;
      for (const double t : right.times) {
        timed->seek(t);
        sum += timed->velocity();
      }
      const double taken = processor_time() - begin;
      [[maybe_unused]] volatile const double kept = sum;  // else a compiler may drop the loop
      seconds.push_back(taken / static_cast<double>(right.times.size()));
      if (taken > 0.5) break;
    }
    std::sort(seconds.begin(), seconds.end());
    const std::size_t n = seconds.size();
    result.seconds = seconds[n / 2];
    result.scatter = (seconds[3 * n / 4] - seconds[n / 4]) / 2;
  } catch (const Error& error) {
    result.failure = error.what();
  }
  return result;
}

}  // namespace rolling
