// SPDX-License-Identifier: GPL-3.0-or-later
// Simulates the run of a roll by a motion sensor (sonar) at the end of the track, with noise,
// rounding and lost echoes: raw data for which the law and the start are known.
#pragma once

#include "motion/scene.h"

#include <cmath>
#include <functional>
#include <optional>

namespace rolling {

/// The defaults describe a sonar of PASCO, and a push by hand that begins and ends smoothly.
struct SonarOptions {
  double rate = 25;           ///< rows a second
  double resolution = 0.001;  ///< positions are rounded to this [m]; 0: not at all
  double noise = 0.0003;      ///< standard deviation of a position before rounding [m]
  double lost = 0.01;         ///< fraction of echoes that do not come back
  unsigned long seed = 1;
  /// Time from the end of the push to the end of the run [s]; infinite: the run ends
  /// rest_after after the stop.
  double until = INFINITY;
  /// The way from the release to the stop [m] of a body that rolls towards the sensor, as in the
  /// paper: distances fall, to `start` at the stop. Without it the body rolls away from `start`.
  std::optional<double> towards;

  static constexpr double rest_before = 1;  ///< at rest before the push [s]
  static constexpr double push = 0.5;       ///< duration of the push [s]
  static constexpr double rest_after = 1;   ///< at rest after the stop [s]
  static constexpr double start = 0.3;      ///< distance at the beginning, or at the stop [m]
};

/// One row; x or v is missing where the echo was lost.
struct SonarSample {
  double t;                 ///< since the start of the run [s]
  std::optional<double> x;  ///< distance [m]
  std::optional<double> v;  ///< (x[i+1] + x[i+2] - x[i-1] - x[i-2]) / (6 dt) of the recorded
                            ///< positions, with one decimal more than they have [m/s]
};

/// The body is at rest. A hand pushes it with v = v0 sin^2(pi u/(2 push)), u being the time since
/// the beginning of the push, up to the speed v0 that the motion has at its t = 0. Then the body
/// rolls freely, and finally it is at rest. White Gaussian noise is added to each position before
/// the rounding. The same seed gives the same run on every machine; `lost` does not change the
/// noise of the other rows. `write` receives one sample after the other; five are kept in
/// memory. Throws Error for more than 1e9 samples, as where the motion never stops.
void sonar_run(Motion&, const SonarOptions&, const std::function<void(const SonarSample&)>& write);

}  // namespace rolling
