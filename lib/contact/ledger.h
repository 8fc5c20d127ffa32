// Where the energy goes (Eqs. 14 to 23). What leaves the body is positive; see rolling-motion(7)
// for the signs.
#pragma once

#include "contact/body.h"

namespace rolling {

/// The ledger at one instant.
struct Ledger {
  double E_trans;  ///< translational energy [J]
  double E_rot;    ///< rotational energy [J]
  double I_E1;     ///< outflow with horizontal momentum [W] (Eq. 17)
  double I_E2;     ///< outflow with vertical momentum [W] (Eq. 21)
  double P_T1;     ///< released by p_x falling through the body [W] (Eq. 18)
  double P_R1;     ///< pumps angular momentum in [W]
  double P_R2;     ///< released by L leaving at omega [W] (Eq. 19)
  double P_T2;     ///< pumps p_y in [W]
  double P_diss;   ///< dissipated in the mat, I_E1 + I_E2 [W] (Eq. 22)
};

/// From velocity [m/s] (the stored energy) and shift [m] (the flows: forces, never a difference of
/// v). Throws Error when |D| > R.
Ledger ledger(const Body&, Geometry, double v, double D);

}  // namespace rolling
