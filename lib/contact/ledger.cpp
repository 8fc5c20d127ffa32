#include "contact/ledger.h"

#include "contact/contact.h"

namespace rolling {

Ledger ledger(const Body& c, Geometry geometry, double v, double D) {
  check_shift(c, D);
  const double A = arm_factor(c, geometry, D);
  const double F_N = c.m * c.g, F_H = horizontal_force(c, geometry, D);
  const double one_minus_A =
      geometry == Geometry::approximate ? 0 : (D / c.R) * (D / c.R) / (1 + A);
  Ledger e{};  // 0 - x where a sign would do: rest gives +0
  e.E_trans = c.m * v * v / 2;
  e.E_rot = c.K * c.m * v * v / 2;
  e.I_E1 = 0 - one_minus_A * v * F_H;                  // Eq. 17
  e.I_E2 = D / c.R * v * F_N;                          // Eq. 21
  e.P_T1 = A * v * D * c.m * c.g / (c.R * (c.K + A));  // Eq. 18
  e.P_R1 = 0 - e.P_T1;
  e.P_R2 = v / c.R * D * c.m * c.g;  // Eq. 19
  e.P_T2 = 0 - e.P_R2;
  e.P_diss = e.I_E1 + e.I_E2;  // Eq. 22
  return e;
}

}  // namespace rolling
