// SPDX-License-Identifier: GPL-3.0-or-later
// The error and the processor time of a method on a scene.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "motion/scene.h"

namespace rolling {

/// The reference for the comparison of methods: speeds at given times, and the time of the stop.
struct Reference {
  std::vector<double> times, speeds;
  double stop;  ///< infinity if the body does not stop
};

/// The reference at n evenly spaced times from 0 to 1.2 times the stop, or to `end` [s] if the stop
/// is later than 1000 times `end`. With memory the times end at the stop, because rest is declared
/// there, whereas the solution of the equations continues to oscillate. The speeds are those of the
/// best method; with memory that is the solver with a relative tolerance of 1e-13.
Reference reference(const Scene&, std::size_t n, double end);

struct Measured {
  double v_error = 0;     ///< largest |v - reference|, over the first speed
  double stop_error = 0;  ///< relative; 0 if there is no stop
  unsigned long evaluations = 0;
  double seconds = 0;   ///< of the processor per sample, with the start
  std::string failure;  ///< message of the Error that ended the measurement, or empty
};

/// Computes one roll for the errors, which also warms the cache, and for the time as many as take
/// 20 ms.
Measured measure(const std::function<std::unique_ptr<Motion>()>& start, const Reference&);

}  // namespace rolling
