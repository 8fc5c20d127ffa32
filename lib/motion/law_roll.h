// The free roll under any law D(v; c) and its derivatives by the coefficients c, for the comparison
// of laws. For the law a v^b alone, Trajectory does the same with smaller errors.
#pragma once

#include "contact/body.h"
#include "contact/law.h"

#include <array>

namespace rolling {

/// The law is autonomous, so that time and distance are integrals over speed (Eq. 12), with q =
/// -v'(u) the deceleration at the speed u:
///   t = int_v^v0 du/q,   x = int_v^v0 u du/q.
/// The variable of integration is ln(v0/u). The Gauss-Legendre rule of four points is used on short
/// panels, which are added up to the latest time that is asked for. The relative error is about
/// 1e-10. Where q is 0 at a speed, the body tends to that speed and never reaches it.
class LawRoll {
 public:
  /// c are the coefficients of the law, in its units; they are copied. Throws Error where the body
  /// does not slow down at v0, for v0 <= 0, and in the exact geometry where |D| > R.
  LawRoll(const Body&, Geometry, const LawInUnits&, const double* c, double v0);

  static constexpr std::size_t most = Law::most + 1;
  using Derivatives = std::array<double, most>;  ///< by the coefficients, then by the slope
  struct Point {
    double v, x;
    double v_v0, x_v0;
    Derivatives v_c, x_c;
  };
  /// The state at t >= 0, which may not fall from call to call, x from 0 at t = 0; and the partial
  /// derivatives at fixed t. From the stop on v = 0, with zero derivatives. Throws Error for a law
  /// that changes by many orders of magnitude over the speeds.
  Point at(double t);

 private:
  struct Rate {
    double q;         // -v' [m/s^2]
    Derivatives q_c;  // its derivatives
  };
  struct Sums {
    double time = 0, distance = 0;
    Derivatives G{}, U{};  // int q_c/q^2 du, int u q_c/q^2 du
  };
  struct Panel {
    double u, q;       // at its beginning; it ends at u e^-width
    double width = 0;  // 0: what follows is a stop or a steady speed
    double q_end = 0;
    Sums before = {}, after = {};
  };
  Rate rate(double u) const;
  bool add(Sums&, double u, double width) const;  // false where q is not positive
  double time(double u, double width) const;
  Panel panel_from(double u, double q, const Sums& before) const;
  Point point(const Sums&, double v, double q) const;
  Point integrated(double since) const;  // in the panel, so long after its beginning
  void take_series();
  Point by_series(double since) const;

  Body body_;
  Geometry geometry_;
  LawInUnits law_;
  std::array<double, Law::most> c_{};
  double v0_, q0_;
  Panel panel_{};
  int panels_ = 0;
  // The Chebyshev coefficients of all numbers of a Point over the panel.
  static constexpr std::size_t terms = 16, worth_a_series = 4 * terms;
  using Numbers = std::array<double, sizeof(Point) / sizeof(double)>;
  std::array<Numbers, terms> series_;
  std::size_t asked_ = 0;  // in the panel
};

}  // namespace rolling
