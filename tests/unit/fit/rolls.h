// SPDX-License-Identifier: GPL-3.0-or-later
// Rolls of the cylinder of the paper, for joint fits.
#pragma once

#include "motion/roll.h"
#include "unit/fit/simulated.h"

namespace rolls {

using namespace rolling;

inline const Body cylinder{1.375, 0.04, 0.5};

/// Positions every 40 ms with noise, down to the stop; way -1 towards falling x.
inline Run roll(PowerLaw law, double slope, double way, simulated::Noise& noise,
                double size = 3e-4) {
  Run run{};
  run.body = cylinder;
  Body seen = cylinder;
  seen.slope = way * slope;
  Roll truth(seen, law, 0.5);
  // Rubber 5 mm/m downhill holds no body at rest: it creeps on at 0.03 mm/s.
  const double end = std::min(truth.stop_time(), 10.0);
  for (double t = 0; t < end; t += 0.04) {
    run.t.push_back(t);
    run.x.push_back(way * truth.at(t).x + noise(size));
  }
  return run;
}

inline constexpr PowerLaw rubber{1.87e-3, 0.215}, felt{5.75e-4, 0.0244};

}  // namespace rolls
