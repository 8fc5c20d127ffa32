// SPDX-License-Identifier: GPL-3.0-or-later
// A scene, its motion as a function of time, and the methods that compute it: their error and their
// processor time.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "contact/body.h"
#include "law/law.h"
#include "motion/roll.h"
#include "ode/integrator.h"

namespace rolling {

/// The bulge has the state z, with z' = (v D(|v|) - |v| z) / length, and the shift is
/// z + damping z': the bristle of Dahl's and the LuGre model of friction (Canudas de Wit et al.
/// 1995, IEEE Trans. Automat. Contr. 40, 419).
struct Bulge {
  double length;       ///< rolled length over which the shift approaches the law [m], > 0
  double damping = 0;  ///< sigma_1 [s], >= 0
};

struct Scene {
  Body body;
  Law law;
  Bulge bulge{0};  ///< of length 0: no memory
  double v0, x0;   ///< at t = 0; v0 >= 0
};

/// A free roll from v0 at t = 0, the same interface for all methods: seek() sets the time, and the
/// other functions return the state at that time. Each quantity is computed only when it is
/// requested.
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
  /// The roll that this motion is, which has derivatives; nullptr for a solver.
  virtual Roll* roll() { return nullptr; }
  /// The number of evaluations of a differential equation by seek().
  virtual unsigned long evaluations() const = 0;
};

/// closed, exact: integrals over speed, by Roll, which are closed forms for some scenes. solver: a
/// differential equation, by this stepper.
struct Method {
  enum { closed, exact, solver } kind;
  Stepper stepper = gsl_odeiv2_step_rk8pd;
};

/// The fastest method that is exact for the scene: closed for a v^b with A = 1 on a level mat; with
/// memory, where neither exists, the solver that suits the stiffness; else exact.
Method best_method(const Scene&);

inline constexpr double finest = 1e-12;  ///< the tolerance of a roll on a road

/// Constructs the motion at t = 0. rtol is the tolerance of a step of a solver, or on a road;
/// most_steps the largest number of steps of a solver from one seek() to the next. Throws Error if
/// x0 is not finite, as check_roll does, and if the method does not suit the scene. Where D grows
/// to R, the law loses its meaning: later times throw Error, and stop_time() is infinite.
std::unique_ptr<Motion> start(const Scene&, Method, double rtol,
                              unsigned long most_steps = 1'000'000);

/// The reference for the comparison of methods: speeds at given times, and the time of the stop.
struct Reference {
  std::vector<double> times, speeds;
  double stop;  ///< infinity if the body does not stop
};

/// The reference at n evenly spaced times from 0 to 1.2 times the stop, or to `end` [s] on a road
/// and if the stop is later than 1000 times `end`. With memory the times end at the stop, because
/// rest is declared there, whereas the solution of the equations continues to oscillate. The speeds
/// are those of the best method; with memory that is the solver with a tolerance of 1e-13, on a
/// road one of `finest`.
Reference reference(const Scene&, std::size_t n, double end);

struct Measured {
  double v_error = 0;     ///< largest |v - reference|, over the highest speed
  double stop_error = 0;  ///< relative; 0 if there is no stop, or one at t = 0
  unsigned long evaluations = 0;
  double seconds = 0;   ///< of the processor per sample, with the start
  std::string failure;  ///< message of the Error that ended the measurement, or empty
};

/// Computes one roll for the errors, which also warms the cache, and for the time as many as take
/// 20 ms.
Measured measure(const std::function<std::unique_ptr<Motion>()>& start, const Reference&);

}  // namespace rolling
