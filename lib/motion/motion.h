// A roll as a function of time, the same interface for all methods: seek() sets the time, and the
// other functions return the state at that time.
#pragma once

namespace rolling {

/// A free roll from v0 at t = 0. Each quantity is computed only when it is requested.
class Motion {
 public:
  virtual ~Motion() = default;
  /// The time from which on v is 0 [s]; infinity if the body never stops.
  virtual double stop_time() const = 0;
  /// The limit of v if the body never stops [m/s]; infinity if its speed grows without bound.
  virtual double last_speed() const { return 0; }
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
