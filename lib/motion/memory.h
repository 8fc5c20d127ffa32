// SPDX-License-Identifier: GPL-3.0-or-later
// The roll over a bulge with memory: the shift follows D(v) over a rolled length, so that the body
// rolls backwards before it rests.
#pragma once

#include "contact/law.h"
#include "motion/solved_roll.h"

#include <optional>

namespace rolling {

/// The bulge has the state z, with z' = (v D(|v|) - |v| z) / length, and the shift is
/// z + damping z': the bristle of Dahl's and the LuGre model of friction (Canudas de Wit et al.
/// 1995, IEEE Trans. Automat. Contr. 40, 419).
struct Bulge {
  double length;       ///< rolled length over which the shift approaches the law [m], > 0
  double damping = 0;  ///< sigma_1 [s], >= 0
};

/// The solver for this stiffness. With q = c D(v0), the bulge and v follow each other within the
/// time length/(v0 + damping q), and the body slows down within v0/q + damping b. If the ratio of
/// these times exceeds 3e4 the system is stiff: the result is rk4imp, otherwise rk8pd.
Stepper memory_stepper(const Body&, PowerLaw, Bulge, double v0);

/// x' = v, v' = -g D / ((K + A) R) (Eq. 12), z as in Bulge; z = D(v0) at t = 0.
///
/// Rest: with c = g / ((K + A) R),  E = c z^2 / 2 + a |v|^(2+b) / ((2+b) length)  never grows
/// (while damping |v| < 4 length), so it bounds every later speed. The ringing dies out only like a
/// power of time; rest is declared at the first zero of v after the roll backwards after which E
/// keeps |v| below v0 / 1000. A strongly damped bulge creeps back without another zero of v: rest
/// is also where the bound has fallen to a thousandth of what it was at the first zero. From rest
/// on v and D are exactly 0. So the roll backwards is there for every length. For b >= 2 the shift
/// fades too fast to stop the body: stop_time() is infinite. So it is on a slope: at rest the bulge
/// would relax, and the body creeps down.
class MemoryRoll final : public SolvedRoll {
 public:
  /// Throws Error as check_roll does, and for b < 0 (no finite shift at rest), length <= 0 or
  /// damping < 0. `rtol` is the relative error of x, v and z that a step may have. seek() and
  /// stop_time() throw the errors of the solver, and after 40 most_steps evaluations in one call.
  MemoryRoll(const Body&, Geometry, PowerLaw, Bulge, double v0, double x0, Stepper, double rtol,
             unsigned long most_steps = 1'000'000);

  /// The first call integrates to the rest, independently of seek().
  double stop_time() override;
  void seek(double t) override;
  double position() override { return x(); }
  double velocity() override { return at_rest_ ? 0 : v(); }
  double shift() override;

 private:
  double fastest(const std::vector<double>& y) const;  // the bound of |v| from this state on
  /// Integrates to t or to the rest, whichever is earlier, and returns true at rest. `crept` is the
  /// bound of |v| at which creep counts as rest; 0 up to the first zero of v.
  bool advance(Integrator&, double& crept, double t) const;

  PowerLaw law_;
  Bulge bulge_;
  unsigned long most_evaluations_;  // of one call
  double crept_ = 0;
  bool at_rest_ = false;
  std::optional<double> stop_time_;
};

}  // namespace rolling
