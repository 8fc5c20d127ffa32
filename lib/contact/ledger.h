// Every quantity of the paper that follows from the velocity and the shift at one instant (Eqs. 1
// to 22). What leaves the body is positive; rolling-motion(7) gives the reason for the signs.
#pragma once

#include "contact/contact.h"

namespace rolling {

/// The quantities of one instant, each computed when it is asked for. The forces and the flows of
/// energy come from the shift, the stored energy from the velocity.
class Ledger {
 public:
  /// Velocity [m/s] and shift [m]. Throws Error when |D| > R in the exact geometry; with A = 1 the
  /// formulas hold for any D.
  Ledger(const Body&, Geometry, double v, double D);

  double omega() const { return v_ / body_.R; }                    ///< [rad/s] (Eq. 1)
  double p() const { return body_.m * v_; }                        ///< momentum [N s]
  double L() const { return body_.K * body_.m * body_.R * v_; }    ///< J omega [N m s] (Eqs. 2, 3)
  double A() const { return A_; }                                  ///< arm factor (Eq. 8)
  double D() const { return D_; }                                  ///< shift [m]
  double F_N() const { return body_.m * body_.g * incline_.cos; }  ///< normal force [N]
  double F_H() const;                                    ///< force of the mat along it [N] (Eq. 9)
  double tau_N() const;                                  ///< torque of F_N [N m] (Eq. 7)
  double tau_H() const;                                  ///< torque of F_H [N m] (Eq. 6)
  double vP_H() const { return one_minus_A_ * v_; }      ///< velocity of P, along [m/s] (Eq. 16)
  double vP_V() const { return 0 - D_ / body_.R * v_; }  ///< and across the mat [m/s] (Eq. 20)
  double E_trans() const { return body_.m * v_ * v_ / 2; }          ///< translational energy [J]
  double E_rot() const { return body_.K * body_.m * v_ * v_ / 2; }  ///< rotational energy [J]
  double I_E1() const { return 0 - vP_H() * F_H(); }  ///< outflow with p_x [W] (Eq. 17)
  double I_E2() const { return 0 - vP_V() * F_N(); }  ///< outflow with p_y [W] (Eq. 21)
  double P_T1() const {
    return 0 + omega() * tau_H();
  }                                           ///< released by p_x in the body [W] (Eq. 18)
  double P_R1() const { return 0 - P_T1(); }  ///< pumps L in [W]
  double P_R2() const { return 0 - omega() * tau_N(); }  ///< released by L leaving [W] (Eq. 19)
  double P_T2() const { return 0 - P_R2(); }             ///< pumps p_y in [W]
  double P_T3() const { return I_E1(); }             ///< released by p_x in the mat, at rest [W]
  double P_T4() const { return I_E2(); }             ///< released by p_y in the mat, at rest [W]
  double P_diss() const { return I_E1() + I_E2(); }  ///< dissipated in the mat [W] (Eq. 22)
  double P_g() const;  ///< goes into lifting the body on an incline [W]

 private:
  const Body& body_;
  Incline incline_;
  double v_, D_, A_, one_minus_A_;
};

}  // namespace rolling
