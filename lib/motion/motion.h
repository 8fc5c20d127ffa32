// A roll as a function of time, whatever the method: seek() goes to a time, and the others tell the
// state there.
#pragma once

namespace rolling {

/// A free roll from v0 at t = 0. Only what is called for is computed.
class Motion {
 public:
  virtual ~Motion() = default;
  /// When v is 0 and stays 0 [s]; infinity if the body never stops.
  virtual double stop_time() const = 0;
  /// What v tends to where the body never stops [m/s]; infinity where it speeds up for ever.
  virtual double last_speed() const { return 0; }
  /// Goes to time t [s] >= 0; calls go forward in time.
  virtual void seek(double t) = 0;
  virtual double position() = 0;      ///< x [m]
  virtual double velocity() = 0;      ///< v [m/s]
  virtual double acceleration() = 0;  ///< dv/dt [m/s^2]
  virtual double shift() = 0;         ///< D [m]
  /// How often seek() has evaluated a differential equation.
  virtual unsigned long evaluations() const { return 0; }
};

}  // namespace rolling
