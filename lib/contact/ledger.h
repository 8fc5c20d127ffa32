// SPDX-License-Identifier: GPL-3.0-or-later
// The quantities of the paper that follow from the velocity and the shift at one instant (Eqs. 1 to
// 22), and the energy balance of a run (Eq. 23). Flows out of the body are positive;
// rolling-motion(7) gives the reason for the signs.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/two_sum.h"
#include "base/error.h"
#include "contact/contact.h"

namespace rolling {

/// The quantities of one instant, in SI units. Forces and energy flows are computed from the shift,
/// the stored energy from the velocity.
class Ledger {
 public:
  /// Velocity [m/s] and shift [m]. Throws Error when |D| > R in the exact geometry; with A = 1 the
  /// formulas hold for any D.
  Ledger(const Body& c, Geometry geometry, double v, double D)
      : body_(c), incline_(incline(c)), v_(v), D_(D), omega_(v / c.R) {
    if (geometry == Geometry::exact) {
      check_shift(c, D);
      A_ = arm_factor(c, geometry, D);
      one_minus_A_ = (D / c.R) * (D / c.R) / (1 + A_);  // does not cancel
    }
    // On an incline F_H = m (v' + g sin theta) with v' of Eq. 12.
    F_H_ = 0 - (D * incline_.cos - c.K * c.R * incline_.sin) * c.m * c.g / ((c.K + A_) * c.R);
  }

  double v() const { return v_; }  ///< velocity [m/s]
  // 0 - x instead of -x, and 0 + x where a factor may be 0: the result is then +0, not "-0".
  double omega() const { return omega_; }                            ///< [rad/s] (Eq. 1)
  double p() const { return body_.m * v_; }                          ///< momentum [N s]
  double L() const { return 0 + body_.K * body_.m * body_.R * v_; }  ///< [N m s] (Eqs. 2, 3)
  double A() const { return A_; }                                    ///< arm factor (Eq. 8)
  double D() const { return D_; }                                    ///< shift [m]
  double F_N() const { return body_.m * body_.g * incline_.cos; }    ///< normal force [N]
  double F_H() const { return F_H_; }              ///< force of the mat along it [N] (Eq. 9)
  double tau_N() const { return 0 - D_ * F_N(); }  ///< torque of F_N [N m] (Eq. 7)
  double tau_H() const { return 0 - A_ * body_.R * F_H_; }  ///< torque of F_H [N m] (Eq. 6)
  double vP_H() const { return 0 + one_minus_A_ * v_; }  ///< velocity of P along the mat (Eq. 16)
  double vP_V() const { return 0 - D_ * omega_; }        ///< and across it [m/s] (Eq. 20)
  double E_trans() const { return body_.m * v_ * v_ / 2; }          ///< translational energy [J]
  double E_rot() const { return body_.K * body_.m * v_ * v_ / 2; }  ///< rotational energy [J]
  double I_E1() const { return 0 - vP_H() * F_H_; }     ///< outflow with p_x [W] (Eq. 17)
  double I_E2() const { return 0 - vP_V() * F_N(); }    ///< outflow with p_y [W] (Eq. 21)
  double P_T1() const { return 0 + omega_ * tau_H(); }  ///< released by p_x in the body (Eq. 18)
  double P_R1() const { return 0 - P_T1(); }            ///< used to pump L in [W]
  double P_R2() const { return 0 - omega_ * tau_N(); }  ///< released by L leaving [W] (Eq. 19)
  double P_T2() const { return 0 - P_R2(); }            ///< used to pump p_y in [W]
  double P_T3() const { return I_E1(); }                ///< released by p_x in the mat [W]
  double P_T4() const { return I_E2(); }                ///< released by p_y in the mat [W]
  double P_diss() const { return I_E1() + I_E2(); }     ///< dissipated in the mat [W] (Eq. 22)
  /// Power against gravity on an incline [W].
  double P_g() const { return body_.m * body_.g * incline_.sin * v_; }

 private:
  const Body& body_;
  Incline incline_;
  double v_, D_, omega_, A_ = 1, one_minus_A_ = 0, F_H_;
};

/// The running integral of a column over time. Each step is integrated under the parabola through
/// its two samples and the one before (the third-order rule of Adams and Moulton on uneven times):
/// the error is of third order in the spacing. The trapezoidal rule replaces it where the parabola
/// would be wrong: for the first step, for a step much longer than the one before, and for a step
/// from or to a sample of exactly 0, which is rest: the power has a corner there.
class Integral {
 public:
  /// Adds the next sample (times increase) and returns the integral from the first sample to this
  /// one. The sum is compensated (Neumaier), so rounding errors do not accumulate in long runs.
  double push(double t, double y) {
    if (begun_) {
      const double h = t - t_, k = last_step_, rise = y - y_;
      double part = 0.5 * h * (y + y_);
      if (h <= most_times * k && y != 0 && y_ != 0)
        part -= h * h / (6 * (h + k) * k) * (rise * k - last_rise_ * h);
      const TwoSum sum = two_sum(sum_, part);
      sum_ = sum.hi, error_ += sum.lo;
      last_step_ = h, last_rise_ = rise;
    }
    begun_ = true;
    t_ = t, y_ = y;
    return sum_ + error_;
  }

 private:
  /// The limit lies between whole numbers, which are the ratios of the steps where rows are
  /// lost: no rounding of the times decides.
  static constexpr double most_times = 2.5;

  bool begun_ = false;
  double t_ = 0, y_ = 0;
  double last_step_ = 0, last_rise_ = 0;  // of t and of y; 0 before the first step
  double sum_ = 0, error_ = 0;
};

/// The energy balance of a run: the loss of stored energy against the energy that the shift
/// dissipates, at every moment and at the end.
class Balance {
 public:
  explicit Balance(const Body& body) : inclined_(body.slope != 0) {}

  /// Adds the next row of the run: its time [s] and its quantities.
  void push(double t, const Ledger& now) {
    end_ = now.E_trans() + now.E_rot();
    if (!begun_) start_ = end_, worst_time_ = t;
    begun_ = true;
    dissipated_ = outflow_.push(t, now.P_diss());
    if (inclined_) lifted_ = lift_.push(t, now.P_g());
    const double off = std::abs(start_ - end_ - lifted_ - dissipated_);
    // There is no branch, which the processor would often predict wrongly: noise decides.
    const double times[] = {worst_time_, t};
    worst_time_ = times[off > worst_];
    worst_ = std::max(worst_, off);
  }

  bool empty() const { return !begun_; }   ///< no row has been added
  double start() const { return start_; }  ///< E_trans + E_rot at the first row [J]
  double end() const { return end_; }      ///< and at the last [J]
  /// I_E1 + I_E2 integrated over time so far [J].
  double dissipated() const { return dissipated_; }
  /// The work against gravity so far [J]: m g sin theta v integrated over time; 0 on a level mat.
  double lifted() const { return lifted_; }

  /// dissipated / (start - end - lifted) - 1: 0 if shift and velocity agree over the whole run.
  /// Throws Error if the denominator, the energy that is missing at the end, is 0.
  double closure() const { return dissipated_ / missing() - 1; }
  /// The largest |start - E(t) - lifted(t) - dissipated(t)| of the run, divided by the energy that
  /// is missing at its end: 0 if shift and velocity agree at every moment. Throws as closure().
  double imbalance() const { return worst_ / std::abs(missing()); }
  double time_of_imbalance() const { return worst_time_; }  ///< the time of that moment [s]

 private:
  double missing() const {
    const double energy = start_ - end_ - lifted_;
    if (energy == 0)
      fail(
          "the body has as much energy at the end of the run as at its start: there is no closure");
    return energy;
  }

  Integral outflow_, lift_;
  bool inclined_, begun_ = false;
  double start_ = 0, end_ = 0, dissipated_ = 0, lifted_ = 0;
  double worst_ = 0, worst_time_ = 0;  // the largest imbalance [J] and its time [s]
};

}  // namespace rolling
