// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a roll in which the speed only falls or only grows, as integrals over speed.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/chebyshev.h"
#include "contact/contact.h"
#include "law/law.h"

namespace rolling {

/// The law is autonomous: with the deceleration q(u) = -v' (Eq. 12) at the speed u,
///   t = int du/|q|,   x = int u du/|q|,
/// and the derivatives by the coefficients c of the law, by the slope and by the wind are
///   u_c = -q G,   x_c = u G - U,   G = int q_c/(q |q|) du,   U = int u q_c/(q |q|) du.
/// The variable of integration is r = |ln(u0/u)|. The integrands are Chebyshev series over panels
/// of r, whose lengths follow from the last terms of the series, so that they suit the scale of any
/// law; u(t) is the inverse of the first integral by Newton's method. Panels are added when a time
/// is asked for. Times and ways count from the beginning of the leg, along the motion.
///
/// Where the speed tends to a last one, at which q = 0, rounding spoils q and with it G and U. The
/// panels end when the speed is within 1e-7 of the last one, relatively; from there on q, q_v and
/// q_c are linear functions of the speed, and the motion is an exponential function of time.
///
/// For a v^b on a level mat with A = 1, where q is a power of u, all of these are closed forms: no
/// panels are needed (Eq. 13 is their inverse).
class Leg {
 public:
  static constexpr std::size_t most = LawForm::most + 2;
  static constexpr double negligible = 1e-6;  ///< speeds below it, as a part of v0, are rest
  /// By the coefficients, the slope, the wind and, of a RoadRoll, the steepness.
  using Derivatives = std::array<double, most + 1>;
  struct Point {
    double v, x;
    double a;  ///< dv/dt
    double v_v0 = 0, x_v0 = 0;
    Derivatives v_c{}, x_c{};
    double v_x0 = 0, x_x0 = 1;
  };
  /// From the speed v0 >= 0, on a mat that rises by body.slope along the motion, in the wind
  /// body.wind against it; from 0 it ends at once. Throws Error if the law is not defined there.
  Leg(const Body&, const Law&, double v0);

  /// The state at t >= 0, and its derivatives at fixed t. From the stop on, v = 0 and its
  /// derivatives are 0. Throws Error where the speed has grown by a factor e^345.
  Point at(double t);
  /// When v becomes 0 [s]; infinity if it never does. A last speed below 1e-6 v0, which a falling
  /// mat may leave, counts as rest from where it is reached to within 1e-7.
  double stop_time();
  /// The stop if it is not later than t, else infinity.
  double stop_until(double t);
  /// The limit of the speed of a body that never stops; infinity if it grows without bound.
  double last_speed();
  /// The speed at the stop: 0, or that just named.
  double rest_speed() const { return rest_; }
  /// In the exact geometry a D that has grown to R stays R. When that begins, up to the time t, and
  /// the speed there; infinity and 0 if it does not.
  double radius_time(double t);
  double radius_speed() const { return radius_speed_; }
  bool slows() const { return way_ > 0; }
  /// The derivatives of the time of the stop by v0 and by c.
  double stop_time_by_v0() const { return 1 / q0_; }
  Derivatives stop_time_by_c();

 private:
  static constexpr std::size_t terms = 20, values = 2 + 2 * most;
  /// Time, way in units of v0, G, and U in units of v0.
  using Series = ChebyshevSeries<values, terms>;
  using Sums = Series::Values;
  struct Rate {
    double q;          // |dv/dt|, negative where the leg would end
    double q_v;        // dq/dv
    double noise;      // its rounding, in units of eps q
    double steepness;  // |dlnD/dlnu|
    double imbalance;  // |q| over the sum of the sizes of its terms
    Derivatives q_c;

    bool balanced() const { return imbalance <= 20 * std::numeric_limits<double>::epsilon(); }
  };
  /// A piece of the way from r on. Its variable is z = 0 to width. If D = R at its end, A has a
  /// root there; r - r(end) = (z - width)^2/width removes it from the integrands.
  struct Panel {
    double r, width;
    bool to_radius;
    Sums before;
    Series sums;          // from its beginning
    double begin, decay;  // time per z at the beginning, and its logarithmic decrease along z

    double r_of(double z) const { return to_radius ? z * (2 - z / width) : z; }
  };
  enum class End { none, stop, constant_speed, too_fast };

  Rate rate(double u) const;
  double speed(double r) const;
  /// The number of derivatives: the wind has one if the air slows the body.
  std::size_t derivatives() const { return law_.size() + 1 + law_.has_drag(); }
  double next_break() const;
  void end_at_last_speed();
  void reach_radius() {  ///< where the panels end
    radius_time_ = sums_[0];
    radius_speed_ = speed(r_);
  }
  void add_panel();
  std::pair<bool, double> try_panel(double width, bool to_radius);
  Sums closed_sums(double r, double E) const;
  Point closed_point(double t) const;
  void reach(double t);
  double above_last_speed(double u, const Rate&) const;
  Point beyond_panels(double since) const;  // since the end of the last panel [s]
  Point point(const Sums&, double v, double q) const;

  Body body_;
  Law law_;
  double v0_;
  Incline incline_;
  double q0_;
  double way_;                   // 1 if the speed falls, -1 if it grows
  std::optional<double> power_;  // b of the closed forms
  Derivatives q_c_{};            // q_c/q at v0, for these
  std::vector<Panel> panels_;
  double r_ = 0, width_ = 2;  // where the next panel begins, and how long it may be
  Sums sums_{};               // up to there
  End end_ = End::none;
  double rest_ = 0, stop_ = INFINITY;
  double radius_time_ = INFINITY, radius_speed_ = 0;
};

}  // namespace rolling
