// SPDX-License-Identifier: GPL-3.0-or-later
// The roll over a bulge with memory: the shift follows D(v) over a rolled length, so that the body
// rolls backwards before it rests.
#pragma once

#include "motion/solved_roll.h"

namespace rolling {

/// The solver for this stiffness. With q = c D(v0), the bulge and v follow each other within the
/// time length/(v0 + damping q), and the body slows down within v0/q + damping b. If the ratio of
/// these times exceeds 3e4 the system is stiff: the result is rk4imp, otherwise rk8pd.
Stepper memory_stepper(const Scene&);

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
  /// Throws Error for a law that is not a v^b with b >= 0 (no finite shift at rest). `rtol` is the
  /// relative error of x, v and z that a step may have.
  MemoryRoll(const Scene&, Stepper, double rtol, unsigned long most_steps);

  double shift() override;

 private:
  double fastest(const std::vector<double>& y) const;  // the bound of |v| from this state on
  bool advance(Course&, double t, unsigned long steps) override;

  PowerLaw law_;
  Bulge bulge_;
};

}  // namespace rolling
