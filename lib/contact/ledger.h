// SPDX-License-Identifier: GPL-3.0-or-later
// The quantities of the paper that follow from the velocity and the shift at one instant (Eqs. 1 to
// 22). Flows out of the body are positive; rolling-motion(7) gives the reason for the signs.
#pragma once

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

}  // namespace rolling
