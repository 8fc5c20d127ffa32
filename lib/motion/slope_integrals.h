// Time, distance and their derivatives as dimensionless integrals over speed for D(v) = a v^b on a
// mat that is not level, in either geometry.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "contact/body.h"
#include "motion/wanted.h"

namespace rolling {

/// With d = D/R, S = tan(theta) and net = d + A S the body slows down by
///   -dv/dt = g cos(theta) net / (K + A).
/// A body with net > 0 at v0 slows down, one with net < 0 (S < 0) speeds up; net = 0 is a speed
/// that it approaches or leaves, but never passes. So the variable of integration is
/// r = |ln(v0/u)|, and with E = u/v0 = e^-r, or e^r for a body that speeds up,
///   t = v0 / (g cos(theta)) int E (K + A)/|net| dr,
///   x = v0^2 / (g cos(theta)) int E^2 (K + A)/|net| dr.
///
/// The integrals are taken by panels of the 16-point Gauss-Legendre rule. A panel is as long as the
/// singularities of the integrand allow: the complex zeros of net and of A, measured by the ellipse
/// in which the integrand is analytic. Next to D = R, where A has a root, A itself is the variable.
/// Relative errors are about 1e-15.
class SlopeIntegrals {
 public:
  /// depth = D(v0)/R in 0 .. 1; arm_square = 1 - depth^2, from a caller who knows it without
  /// cancellation (not used for A = 1); log_depth = ln(depth), also where depth itself underflows.
  /// K + A must not be 0.
  SlopeIntegrals(Geometry, double b, double K, double depth, double arm_square, double slope,
                 double log_depth);

  /// The time to the stop; infinity if there is none. On a falling mat with b > 0 the speed tends
  /// to the one where net = 0. If that is below 1e-6 v0 it counts as rest, and the stop is the time
  /// at which v is twice that speed.
  double stop() const { return stop_; }
  /// The time at which D reaches R on the way down (exact geometry, b < 0); infinity if it never
  /// does.
  double end() const { return end_; }
  /// The limit of the speed in units of v0: 0 if the body stops, infinity if its speed grows
  /// without bound.
  double last_speed() const { return last_speed_; }
  /// The speed that counts as rest in units of v0: 0, or twice a negligible limit of the speed.
  double rest_speed() const { return rest_speed_; }

  /// A position within the integrals: a panel, r from its beginning, and the time since the end of
  /// the last panel.
  struct Place {
    std::size_t panel;
    double r;
    double beyond = 0;
  };
  /// `rest` is stop() - time from a caller who may know it without cancellation, positive; infinite
  /// when stop() is. time is at most end(). Throws Error where the speed has grown by a factor
  /// e^300.
  Place place(double time, double rest) const;
  Place last() const { return {panels_.size() - 1, panels_.back().width}; }  ///< of the integrals

  double speed(Place) const;  ///< E = v/v0
  /// The integrals that the derivatives need. H = K + 1/A - S K d/A, or K + 1 for A = 1, comes from
  /// d(net/(K + A))/dd. The kernels h = E d H / net^2, of the derivative by ln a, and k = E A (K +
  /// A)/net^2, of that by S.
  struct Gradient {
    double rate;    ///< |net|/(K + A): the deceleration in units of g cos(theta)
    double change;  ///< |1 - E|
    double time, distance;
    double h0, h1, k0;    ///< int of h, h r, k
    double g0, g1, j, w;  ///< the same three and E (K + A)/|net|, with a factor |E - E(end)|
  };
  Gradient gradient(Place, Wanted) const;
  double start_rate() const;  ///< |net|/(K + A) at v0
  bool slows() const { return way_ > 0; }

 private:
  struct Sums {
    double time = 0, distance = 0, h0 = 0, h1 = 0, k0 = 0, g0 = 0, g1 = 0, j = 0, w = 0;
  };
  struct Panel {
    double r, width;
    double left;          // to the speed where net = 0; negative behind it, infinite without one
    bool deep;            // A is the variable
    double A;             // at the beginning
    double begin, decay;  // time per r at the beginning, and its logarithmic decrease along r
    double duration;
    Sums before;  // integrals up to it
    double rest;  // time from it to the stop
  };
  struct Node {
    double r, local;  // from v0, and from the beginning of the panel
    double E_by_net;  // E/|net|
    double d, A, net;
    double dr, dr_by_A;  // with the weight
  };

  double depth_at(double r) const { return depth_ * std::exp(fade_ - beta_ * r); }
  /// The r where depth_at(r) is d.
  double r_of_depth(double d) const { return (std::log(depth_ / d) + fade_) / beta_; }
  double arm(double r) const;
  double net(double d, double A, double left) const;
  double E_by_net(double r, double d, double net) const;
  double width(double r, double left) const;
  double width_by_arm(double r) const;
  double horizon() const;
  void add_panels(double last, double left);
  void add_panel(double r, double left, double width);
  template <typename Integrand>
  void quadrature(const Panel&, double width, Integrand&&) const;
  Sums local(const Panel&, double width, Wanted) const;
  double local_time(const Panel&, double r) const;
  double time_per_r(const Panel&, double r) const;
  Sums total(const Panel&, double r, const Sums& local) const;

  bool exact_;
  double b_, K_, depth_, arm_square_, slope_;
  double sine_;      // d where net = 0, as a positive number: |sin(theta)|, or |S| for A = 1
  double fade_;      // d at v0 is depth e^fade: 0 unless it is near the least double or below it
  double way_ = 1;   // or -1: speeds up
  double beta_;      // d = depth e^(fade - beta r)
  double crossing_;  // r where d = sine; complex conjugates of it are there for S > 0
  double deep_end_;  // r where D = R/2
  std::vector<Panel> panels_;
  double stop_ = std::numeric_limits<double>::infinity();
  double end_ = std::numeric_limits<double>::infinity();
  double last_speed_ = 0, rest_speed_ = 0;
};

}  // namespace rolling
