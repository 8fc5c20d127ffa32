// What a method costs on a scene, and how far it is off: work and precision.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "motion/motion.h"
#include "motion/roll.h"

namespace rolling {

/// Speeds at given times, and the stop, that count as right.
struct Reference {
  std::vector<double> times, speeds;
  double stop;  ///< infinity: none
};

/// n times evenly to 1.2 times the stop, or to `end` [s] where there is none before 1000 times
/// that; with memory to the stop, for rest is declared there, where solvers by themselves ring on.
/// Speeds from the best method; with memory from its solver at a relative tolerance of 1e-13.
Reference reference(const Roll&, std::size_t n, double end);

struct Measured {
  double v_error = 0;     ///< largest |v - reference| / v0
  double stop_error = 0;  ///< relative; 0 without a stop
  unsigned long evaluations = 0;
  double seconds =
      0;  ///< of the processor per sample, its motion set up included: median of the repeats
  double scatter = 0;   ///< half the distance of their quartiles [s]
  std::string failure;  ///< the Error that ended it, or empty
};

/// Rolls once for the errors and then `repeats` times for the time; a first run is not counted. A
/// run that takes more than half a second is not repeated.
Measured measure(const std::function<std::unique_ptr<Motion>()>& start, const Reference&, double v0,
                 int repeats);

}  // namespace rolling
