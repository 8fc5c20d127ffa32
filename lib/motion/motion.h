// SPDX-License-Identifier: GPL-3.0-or-later
// A roll as a function of time, the same interface for all methods: seek() sets the time, and the
// other functions return the state at that time.
#pragma once

namespace rolling {

/// A free roll from v0 at t = 0. Each quantity is computed only when it is requested.
class Motion {
 public:
  virtual ~Motion() = default;
  /// The time from which on v is 0 [s], or of the turning point; infinity if there is none.
  virtual double stop_time() = 0;
  /// The limit of v if the body never rests [m/s], which may be infinite.
  virtual double last_speed() { return 0; }
  /// Sets the time t [s] >= 0, which must not decrease from call to call.
  virtual void seek(double t) = 0;
  virtual double position() = 0;      ///< x [m]
  virtual double velocity() = 0;      ///< v [m/s]
  virtual double acceleration() = 0;  ///< dv/dt [m/s^2]
  virtual double shift() = 0;         ///< D [m]
  /// The number of evaluations of a differential equation by seek().
  virtual unsigned long evaluations() const { return 0; }
};

}  // namespace rolling
