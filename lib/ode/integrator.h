// SPDX-License-Identifier: GPL-3.0-or-later
// Autonomous differential equations y' = f(y) by the adaptive steppers of GSL: forward in time, to
// given times or to an event.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace rolling {

/// y is the state, of as many numbers as the one that the integrator begins with. The functions
/// pass through C code: they do not throw.
struct OdeSystem {
  std::function<void(const double* y, double* dydt)> derivative;
  std::function<void(const double* y, double* dfdy)> jacobian;  ///< df/dy row by row
  std::function<double(const double* y)> longest_step;          ///< from a state
};

/// GSL's names.
enum class Stepper { rk2, rk4, rkf45, rkck, rk8pd, msadams, rk1imp, rk2imp, rk4imp, bsimp, msbdf };
inline constexpr std::size_t steppers = 11;
const char* name_of(Stepper);  ///< as GSL has it: "rk8pd"

/// The error that a step may have: relative to y, plus in these units of y, plus relative to the
/// change of y in the step.
struct Tolerance {
  double of_value, of_unit, of_change;
  std::vector<double> units;  ///< one for each element of y
};

class Integrator {
 public:
  /// A function of the state whose zero is the event.
  using Event = std::function<double(const std::vector<double>&)>;

  /// From the state y at t = 0.
  Integrator(OdeSystem, Stepper, const Tolerance&, std::vector<double> y);

  double time() const { return t_; }
  const std::vector<double>& state() const { return y_; }
  unsigned long evaluations() const;  ///< calls of the derivative so far

  /// Integrates to exactly t; does nothing if t is not after time(). Stops at the first sign change
  /// of the event (located to rounding) and then returns true. t may be infinite. Subtracts its
  /// steps from `steps`. Throws Error if none is left, or if GSL fails.
  bool advance(double t, const Event&, unsigned long& steps);
  /// Continues from another time and state: at a kink of the derivative, restart on its other side.
  void restart(double t, std::vector<double> y);

 private:
  struct Problem;  // the system and the objects of GSL, which have pointers to it
  void step(double t, unsigned long& steps);
  void locate(double t_before, std::vector<double> y_before, const Event&, unsigned long& steps);

  std::shared_ptr<Problem> problem_;
  double t_ = 0;
  std::vector<double> y_;
  // A first guess, or less where the state changes faster; the error control corrects it.
  double h_ = 1e-6;
};

}  // namespace rolling
