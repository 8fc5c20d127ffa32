// What every way of rolling a body has in common: go to a time, then ask for what is needed there.
#pragma once

namespace rolling {

/// A free roll from v0 at t = 0. Nothing is computed that is not asked for.
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
