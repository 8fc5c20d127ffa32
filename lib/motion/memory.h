// The roll over a bulge that adapts slowly: the shift follows D(v) over a rolled length, and so the
// body rolls backwards before it rests.
#pragma once

#include "contact/power_law.h"
#include "motion/solved_roll.h"

#include <optional>

namespace rolling {

/// The bulge has the state z, with z' = (v D(|v|) - |v| z) / length, and the shift is
/// z + damping z': the bristle of Dahl's and the LuGre model of friction (Canudas de Wit et al.
/// 1995, IEEE Trans. Automat. Contr. 40, 419).
struct Bulge {
  double length;       ///< rolled length over which the shift follows the law [m], > 0
  double damping = 0;  ///< sigma_1 [s], >= 0
};

/// The shift follows v within the time length/v0, the body slows down within v0/(c D(v0)). Where
/// these differ by more than 3e4 the system is stiff: rk4imp, else rk8pd.
Stepper memory_stepper(const Body&, PowerLaw, Bulge, double v0);

/// What any solver has to do from the start to the time t, or to the rest if that is earlier, known
/// before it begins: estimates, good to a factor of about 4.
struct MemoryWork {
  double swings;       ///< how often the body turns round: each turn takes some 100 evaluations
  double relaxations;  ///< of the bulge, which follows the speed: an explicit solver takes two to
                       ///< four evaluations for each
};
MemoryWork memory_work(const Body&, PowerLaw, Bulge, double v0, double t);

/// x' = v, v' = -g D / ((K + A) R) (Eq. 12), z as in Bulge; z = D(v0) at t = 0.
///
/// Rest: with c = g / ((K + A) R),  E = c z^2 / 2 + a |v|^(2+b) / ((2+b) length)  never grows
/// (while damping |v| < 4 length), so it bounds every later speed. The ringing dies out only like a
/// power of time; rest is declared at the first zero of v after the roll backwards after which E
/// keeps |v| below v0 / 1000. From there on v and D are exactly 0. So the roll backwards is there
/// for every length. For b >= 2 the shift fades too fast to stop the body:
/// stop_time() is infinite. So it is on a slope: at rest the bulge would relax, and the body creeps
/// down.
class MemoryRoll final : public SolvedRoll {
 public:
  /// Refuses what check_roll refuses, b < 0 (no shift at rest to return to), length <= 0, damping <
  /// 0. `rtol` is the solver's tolerance in each step, relative to x, v and z.
  /// Errors of the solver come out of seek() and stop_time(). A work of more than 1e5 swings, or
  /// with an explicit solver of more than 2e7 relaxations, is refused before it begins. The work of
  /// one call is bounded by that and by most_steps.
  MemoryRoll(const Body&, Geometry, PowerLaw, Bulge, double v0, double x0, Stepper, double rtol,
             unsigned long most_steps = 1'000'000);

  /// The first call integrates to the rest, apart from where seek() stands.
  double stop_time() const override;
  void seek(double t) override;
  double position() override { return x(); }
  double velocity() override { return at_rest_ ? 0 : v(); }
  double shift() override;

 private:
  bool at_rest() override { return at_rest_; }
  double expected_evaluations(double t) const;  // throws Error where the work is too much
  /// Integrates to t or to the rest, whichever is first, and returns true at rest. `backwards`: v
  /// has had its first zero.
  bool advance(Integrator&, bool& backwards, double t) const;

  PowerLaw law_;
  Bulge bulge_;
  double spare_evaluations_;  // of one call, beyond ten times those expected
  bool backwards_ = false, at_rest_ = false;
  mutable std::optional<double> stop_time_;
};

}  // namespace rolling
