// SPDX-License-Identifier: GPL-3.0-or-later
// Ordinary differential equations y' = f(t, y) by the adaptive steppers of GSL: forward in time, to
// given times or to an event.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace rolling {

/// y is the state, of as many numbers as the one that the integrator begins with. All functions may
/// throw; the exception leaves Integrator::advance().
struct OdeSystem {
  std::function<void(double t, const double* y, double* dydt)> derivative;
  /// df/dy row by row, and df/dt; needed by the implicit steppers.
  std::function<void(double t, const double* y, double* dfdy, double* dfdt)> jacobian = {};
  /// The longest step from a state, where that is known.
  std::function<double(const double* y)> longest_step = {};
};

/// GSL's names.
enum class Stepper { rk2, rk4, rkf45, rkck, rk8pd, msadams, rk1imp, rk2imp, rk4imp, bsimp, msbdf };
inline constexpr std::size_t steppers = 11;
const char* name_of(Stepper);  ///< as GSL has it: "rk8pd"
inline bool is_explicit(Stepper stepper) { return stepper < Stepper::rk1imp; }

struct OdeOptions {
  Stepper stepper = Stepper::rk8pd;
  double rtol = 1e-10;                ///< error of a step relative to y ...
  double atol = 1e-13;                ///< ... plus this, in these units of y ...
  double change = 0;                  ///< ... plus this, relative to the change of y in the step
  unsigned long max_steps = 300'000;  ///< of one advance(); then it is refused
  std::vector<double> units = {};     ///< one for each element of y; 1 if it is empty
};

class Integrator {
 public:
  /// A function of the state whose zero is the event.
  using Event = std::function<double(const std::vector<double>& y)>;

  Integrator(OdeSystem, const OdeOptions&, double t, std::vector<double> y);

  double time() const { return t_; }
  const std::vector<double>& state() const { return y_; }
  unsigned long evaluations() const;  ///< calls of the derivative so far

  /// Integrates to exactly t; does nothing if t is not after time(). Stops at the first sign change
  /// of the event (located to rounding) and then returns true. t may be infinite. Throws Error if
  /// GSL fails, if the state is no longer finite, or after max_steps.
  bool advance(double t, const Event&);
  /// Continues from another time and state: at a kink of the derivative, restart on its other side.
  void restart(double t, std::vector<double> y);

 private:
  struct Problem;  // the system and the objects of GSL, which have pointers to it
  void step(double t);
  void locate(double t_before, double value_before, const Event&);

  std::shared_ptr<Problem> problem_;
  unsigned long max_steps_, steps_left_ = 0;
  double t_;
  std::vector<double> y_, before_;  // before_: at the beginning of the last step
  // A first guess, or less where the state changes faster; the error control corrects it.
  double h_ = 1e-6;
};

}  // namespace rolling
