// The error of a method on a scene, and the time of the processor that it takes.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "motion/motion.h"
#include "motion/roll.h"

namespace rolling {

/// Speeds at given times and the time of the stop, with which methods are compared.
struct Reference {
  std::vector<double> times, speeds;
  double stop;  ///< infinity: none
};

/// At n times, evenly spaced from 0 to 1.2 times the stop, or to `end` [s] where the stop is later
/// than 1000 times that. With memory they end at the stop: there rest is declared, while the
/// equations by themselves ring on. The speeds are those of the best method, which with memory is
/// its solver at a relative tolerance of 1e-13.
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
