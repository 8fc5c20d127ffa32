// The free roll under any law D(v; c) and its derivatives with respect to the coefficients c, for
// the comparison of laws. For the law a v^b alone, Trajectory has smaller errors.
#pragma once

#include "base/chebyshev.h"
#include "contact/body.h"
#include "contact/law.h"

#include <array>

namespace rolling {

/// The law is autonomous, so that time and distance are integrals over speed (Eq. 12), with the
/// deceleration q = -v'(u) at the speed u:
///   t = int_v^v0 du/q,   x = int_v^v0 u du/q.
/// The variable of integration is ln(v0/u). The 4-point Gauss-Legendre rule is applied to short
/// panels up to the latest requested time. The relative error is about 1e-10. If q = 0 at some
/// speed, the body approaches that speed and never reaches it. In the exact geometry a D that grows
/// to R stays R, as with Trajectory::AtRadius::passed; there 1/A, in the derivatives, has a larger
/// error.
class LawRoll {
 public:
  /// `c` holds the coefficients of the law in its units; they are copied. Throws Error if the body
  /// does not slow down at v0, if v0 <= 0, and in the exact geometry if |D| > R at v0.
  LawRoll(const Body&, Geometry, const LawInUnits&, const double* c, double v0);

  static constexpr std::size_t most = Law::most + 1;
  using Derivatives = std::array<double, most>;  ///< by the coefficients, then by the slope
  struct Point {
    double v, x;
    double v_v0, x_v0;
    Derivatives v_c, x_c;
  };
  /// The state at t >= 0, with x = 0 at t = 0, and its partial derivatives at fixed t. t must not
  /// decrease from call to call. From the stop on v = 0 and its derivatives are 0. Throws Error for
  /// a law that changes by many orders of magnitude over the speeds.
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
    double u, q;       // at the beginning of the panel; it ends at u e^-width
    double width = 0;  // 0: a stop (u = 0) or a constant speed follows
    double q_end = 0;
    Sums before = {}, after = {};
  };
  Rate rate(double u) const;
  bool add(Sums&, double u, double width) const;  // false if q is not positive
  double time(double u, double width) const;
  Panel panel_from(double u, double q, const Sums& before) const;
  Point point(const Sums&, double v, double q) const;
  Point integrated(double since) const;  // `since` counts from the beginning of the panel

  Body body_;
  Geometry geometry_;
  LawInUnits law_;
  std::array<double, Law::most> c_{};
  double v0_, q0_;
  Panel panel_{};
  int panels_ = 0;
  static constexpr std::size_t terms = 16, worth_a_series = 4 * terms;
  using Series = ChebyshevSeries<sizeof(Point) / sizeof(double), terms>;
  Series series_;          // all numbers of a Point as functions of time over the panel
  std::size_t asked_ = 0;  // number of calls of at() in the panel
};

}  // namespace rolling
