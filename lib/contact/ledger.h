// SPDX-License-Identifier: GPL-3.0-or-later
// The quantities of the paper that follow from the velocity and the shift at one instant (Eqs. 1 to
// 22), and the energy balance of a run (Eq. 23). Flows out of the body are positive;
// rolling-motion(7) gives the reason for the signs.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/two_sum.h"
#include "contact/contact.h"

namespace rolling {

/// The quantities of one instant, in SI units. Forces and energy flows are computed from the shift,
/// the stored energy from the velocity.
class Ledger {
 public:
  /// Velocity [m/s] and shift [m]. Throws Error when |D| > R in the exact geometry; with A = 1 the
  /// formulas hold for any D.
  Ledger(const Body& c, double v, double D) : Ledger(c, v, D, incline(c)) {}
  /// The same on another incline than that of the body, as on a road.
  Ledger(const Body& c, double v, double D, const Incline& incline)
      : body_(c), incline_(incline), v_(v), D_(D), omega_(v / c.R) {
    if (c.exact) {
      check_shift(c, D);
      A_ = arm_factor(c, D);
      one_minus_A_ = (D / c.R) * (D / c.R) / (1 + A_);  // does not cancel
    }
    // On an incline F_H = m (v' + g sin theta) with v' of Eq. 12.
    F_H_ = 0 - (D * incline_.cos - c.K * c.R * incline_.sin()) * c.m * c.g / ((c.K + A_) * c.R);
  }

  double v() const { return v_; }                                     ///< velocity [m/s]
  double J() const { return body_.K * body_.m * body_.R * body_.R; }  ///< [kg m^2] (Eq. 2)
  // 0 - x instead of -x, and 0 + x where a factor may be 0: the result is then +0, not "-0".
  double omega() const { return omega_; }                            ///< [rad/s] (Eq. 1)
  double p() const { return body_.m * v_; }                          ///< momentum [N s]
  double L() const { return 0 + body_.K * body_.m * body_.R * v_; }  ///< [N m s] (Eqs. 2, 3)
  double A() const { return A_; }                                    ///< arm factor (Eq. 8)
  double D() const { return D_; }                                    ///< shift [m]
  double F_N() const { return body_.m * body_.g * incline_.cos; }    ///< normal force [N]
  double F_H() const { return F_H_; }                     ///< force of the mat along it [N] (Eq. 9)
  double F_S() const { return std::hypot(F_H_, F_N()); }  ///< force of the mat [N]: both parts
  double F_G() const { return body_.m * body_.g; }        ///< weight [N]
  double tau_N() const { return 0 - D_ * F_N(); }         ///< torque of F_N [N m] (Eq. 7)
  double tau_H() const { return 0 - A_ * body_.R * F_H_; }  ///< torque of F_H [N m] (Eq. 6)
  // The currents of the carriers of energy, positive if they leave the body: the mat supplies what
  // its force and torque are, and I_E1 = vP_H I_pH, I_E2 = vP_V I_pN.
  double I_pH() const { return 0 - F_H_; }     ///< of momentum along the mat [N] (Eq. 4)
  double I_pN() const { return 0 - F_N(); }    ///< of momentum across the mat [N]
  double I_LH() const { return 0 - tau_H(); }  ///< of angular momentum, by F_H [N m] (Eq. 5)
  double I_LN() const { return 0 - tau_N(); }  ///< and by F_N [N m] (Eq. 5)
  double vP_H() const { return 0 + one_minus_A_ * v_; }  ///< velocity of P along the mat (Eq. 16)
  double vP_V() const { return 0 - D_ * omega_; }        ///< and across it [m/s] (Eq. 20)
  double E_trans() const { return body_.m * v_ * v_ / 2; }          ///< translational energy [J]
  double E_rot() const { return body_.K * body_.m * v_ * v_ / 2; }  ///< rotational energy [J]
  double E() const { return E_trans() + E_rot(); }                  ///< stored energy [J]
  double I_E1() const { return 0 - vP_H() * F_H_; }     ///< outflow with p_x [W] (Eq. 17)
  double I_E2() const { return 0 - vP_V() * F_N(); }    ///< outflow with p_y [W] (Eq. 21)
  double P_T1() const { return 0 + omega_ * tau_H(); }  ///< released by p_x in the body (Eq. 18)
  double P_R1() const { return 0 - P_T1(); }            ///< used to pump L in [W]
  double P_R2() const { return 0 - omega_ * tau_N(); }  ///< released by L leaving [W] (Eq. 19)
  double P_T2() const { return 0 - P_R2(); }            ///< used to pump p_y in [W]
  double P_T3() const { return I_E1(); }                ///< released by p_x in the mat [W]
  double P_T4() const { return I_E2(); }                ///< released by p_y in the mat [W]
  /// The part of P_diss that goes into the air, for the part D_air [m] of D that its drag makes
  /// [W].
  double P_air(double D_air) const { return 0 + omega() * F_N() * D_air; }
  double P_diss() const { return I_E1() + I_E2(); }  ///< dissipated in the mat [W] (Eq. 22)
  double F_g() const { return body_.m * body_.g * incline_.sin(); }  ///< weight along the mat [N]
  double P_g() const { return F_g() * v_; }  ///< power against gravity on an incline [W]

 private:
  Body body_;
  Incline incline_;
  double v_, D_, omega_, A_ = 1, one_minus_A_ = 0, F_H_;
};

/// The running integral of a column over time. Each step is integrated under the parabola through
/// its two samples and the one before (the third-order rule of Adams and Moulton on uneven times):
/// the error is of third order in the spacing. Three kinds of steps have no such parabola. The
/// first step, one much longer than the one before, and one from rest are integrated by the
/// trapezoidal rule. Before rest y falls to its value at rest as a power of the time that is left:
/// under D = a v^b, v^b is proportional to (T - t)^(b / (1 - b)). So the step to exactly this value
/// is the integral of the power through the two samples before it.
class Integral {
 public:
  explicit Integral(double at_rest = 0) : at_rest_(at_rest) {}

  /// Adds the next sample (times increase) and returns the integral from the first sample to this
  /// one. The sum is compensated (Neumaier), so rounding errors do not accumulate in long runs.
  double push(double t, double y) {
    y -= at_rest_;
    if (begun_) {
      const double h = t - t_;
      const TwoSum sum = two_sum(sum_, part(h, y));
      sum_ = sum.hi;
      error_ += sum.lo;
      last_step_ = h;
      last_rise_ = y - y_;
    }
    if (!begun_) first_ = t;
    begun_ = true;
    t_ = t;
    y_ = y;
    return value();
  }
  double value() const { return sum_ + error_ + at_rest_ * (t_ - first_); }

 private:
  /// The integral over a step of h that ends at y.
  double part(double h, double y) const {
    const double k = last_step_;
    const double trapezoid = 0.5 * h * (y + y_);
    if (!(h <= most_times * k) || y_ == 0) return trapezoid;
    if (y != 0) return trapezoid - h * h / (6 * (h + k) * k) * ((y - y_) * k - last_rise_ * h);
    const double power = std::log1p(-last_rise_ / y_) / std::log1p(k / h);
    return power > -0.5 ? h * y_ / (1 + power) : trapezoid;
  }

  /// The limit lies between whole numbers, which are the ratios of the steps where rows are
  /// lost: no rounding of the times decides.
  static constexpr double most_times = 2.5;

  double at_rest_;
  bool begun_ = false;
  double first_ = 0;                      // the first time
  double t_ = 0, y_ = 0;                  // the last sample, without the value at rest
  double last_step_ = 0, last_rise_ = 0;  // of t and of y; 0 before the first step
  double sum_ = 0, error_ = 0;
};

/// The account of one quantity that the body stores, energy or momentum: what is missing of it
/// since the first row beside what has flowed into the mat and to gravity. They agree if the shift,
/// which gives the flows, is right for the velocity, which gives what is stored.
class Account {
 public:
  /// At rest so much flows into the mat per second.
  explicit Account(double at_rest = 0) : mat_(at_rest) {}

  /// Adds the next row of the run: its time [s], what is stored, and what flows out per second into
  /// the mat and to gravity.
  void push(double t, double stored, double to_mat, double to_gravity) {
    if (!begun_) {
      start_ = stored;
      worst_time_ = t;
    }
    begun_ = true;
    end_ = stored;
    largest_ = std::max(largest_, std::abs(stored));
    mat_.push(t, to_mat);
    gravity_.push(t, to_gravity);
    const double off = std::abs(missing() - mat_.value());
    // There is no branch, which the processor would often predict wrongly: noise decides.
    const double times[] = {worst_time_, t};
    worst_time_ = times[off > worst_];
    worst_ = std::max(worst_, off);
  }

  bool empty() const { return !begun_; }          ///< no row has been added
  double start() const { return start_; }         ///< what is stored at the first row
  double end() const { return end_; }             ///< and at the last
  double to_mat() const { return mat_.value(); }  ///< what has flowed into the mat so far
  double to_gravity() const { return gravity_.value() + lifted_; }  ///< and to gravity
  /// From the next row on so much has gone to gravity, beside the integral.
  void set_lifted(double all) { lifted_ = all; }

  /// to_mat / (start - end - to_gravity) - 1: 0 if shift and velocity agree over the whole run. NaN
  /// if nothing is missing at the end.
  double closure() const { return missing() == 0 ? NAN : to_mat() / missing() - 1; }
  /// The largest |start - stored(t) - to_gravity(t) - to_mat(t)| of the run, divided by what is
  /// missing at its end: 0 if shift and velocity agree at every moment. NaN as in closure().
  double imbalance() const { return missing() == 0 ? NAN : worst_ / std::abs(missing()); }
  double time_of_imbalance() const { return worst_time_; }  ///< the time of that moment [s]
  /// False if less than a tenth of the largest store is missing, as of the momentum of a body that
  /// has swung to and fro: the closure then says little.
  bool closure_tells() const { return std::abs(missing()) > largest_ / 10; }

 private:
  double missing() const { return start_ - end_ - to_gravity(); }

  Integral mat_, gravity_;
  bool begun_ = false;
  double start_ = 0, end_ = 0, lifted_ = 0;
  double largest_ = 0;                 // of the store
  double worst_ = 0, worst_time_ = 0;  // the largest imbalance and its time [s]
};

/// The accounts of a run: of energy (Eq. 23), of momentum (Eq. 4) and of angular momentum (Eq. 5).
class Balance {
 public:
  /// The momenta are left out unless they are asked for. On a road the energy that is lifted is set
  /// by the caller, from the height.
  Balance(const Body& body, bool momenta)
      : p(at_rest(body).I_pH()), L(at_rest(body).I_LH() + at_rest(body).I_LN()),
        L_H_(at_rest(body).tau_H()), on_road_(body.road), momenta_(momenta) {}

  /// Adds the next row of the run: its time [s] and its quantities.
  void push(double t, const Ledger& now) {
    energy.push(t, now.E(), now.P_diss(), on_road_ ? 0 : now.P_g());
    if (!momenta_) return;
    p.push(t, now.p(), now.I_pH(), now.F_g());
    L.push(t, now.L(), now.I_LH() + now.I_LN(), 0);
    L_H_.push(t, now.tau_H());
  }
  /// Beside it the power that goes into the air, a part of P_diss [W].
  void push_air(double t, double power) { air_.push(t, power); }

  Account energy, p, L;  // in J, N s and N m s
  /// Angular momentum that F_H and F_N have brought in so far [N m s].
  double L_H() const { return L_H_.value(); }
  /// Energy that has gone into the air so far, a part of E_diss [J].
  double to_air() const { return air_.value(); }
  double L_N() const { return 0 - L.to_mat() - L_H(); }

 private:
  static Ledger at_rest(const Body& body) { return {body, 0, 0}; }

  Integral L_H_, air_;
  bool on_road_, momenta_;
};

}  // namespace rolling
