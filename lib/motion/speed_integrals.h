// Time, distance and their derivatives as integrals over speed, for D(v) = a v^b in either
// geometry: numbers without units.
#pragma once

#include <limits>
#include <vector>

namespace rolling {

/// With y = ln(v0/u), s = 1 - b, z = (D(v0)/R)^2 e^(-2 b y), A = sqrt(1 - z) (or 1):
///   f = (K + A) / (K + 1),   h = (K + 1/A) / (K + 1), which replaces f when u^-b f / a is
///   differentiated by a or b.
///
/// For z <= 1/4 and b > 0 the binomial series of A and 1/A make every integral a sum of powers
/// (power_integral.h). Larger z, where that is slow, and b < 0, where z grows: Gauss-Legendre
/// panels, with A itself as the variable of integration (dy = A dA / (b z)), which removes the root
/// of A and the pole of 1/A at D = R.
class SpeedIntegrals {
 public:
  /// depth = D(v0)/R in 0 .. 1, and 0 for A = 1; arm_square = 1 - depth^2, from a caller who knows
  /// it without cancellation. K + A must not be 0.
  SpeedIntegrals(double b, double K, double depth, double arm_square);
  SpeedIntegrals(double b, double K, double depth)
      : SpeedIntegrals(b, K, depth, (1 - depth) * (1 + depth)) {}

  /// int_0^inf f e^(-s y) dy: the time to the stop; infinity if there is no stop.
  double stop() const { return stop_; }
  /// The time at which D reaches R on the way down (b < 0); infinity if it never does.
  double end() const { return end_; }

  /// lambda with int_0^lambda f e^(-s y) dy = time, for time below stop() and up to end(). `rest`
  /// is stop() - time, from the caller, who may know it without cancellation; infinite when stop()
  /// is.
  double lambda(double time, double rest) const;

  /// f at y = lambda.
  double f(double lambda) const;
  /// int_0^lambda f e^(-(s+1) y) dy.
  double distance(double lambda) const;

  /// int (1 - f) e^(-s y) dy, from 0 to lambda and from lambda to infinity (for s > 0): what the
  /// geometry takes from A = 1.
  double lag(double lambda) const;
  double lag_rest(double lambda) const;

  /// The distance, and what derivatives need. All integrals run over 0 < y < lambda.
  struct Gradient {
    double distance;
    double h0, h1;  ///< of h e^(-s y), with a factor y
    double g0, g1;  ///< of h (e^-y - e^-lambda) e^(-s y), with a factor y
  };
  /// Without `way` only h0 and h1.
  Gradient gradient(double lambda, bool way = true) const;

 private:
  struct Term {
    double s, f, f_by_s, h;
  };
  struct Sums {
    double time = 0, lag = 0, distance = 0;
    double h0 = 0, h1 = 0, x0 = 0, x1 = 0;  // of h e^(-s y) and of h e^(-(s+1) y), with a factor y
  };
  struct Piece {
    bool panel;      // or the series
    double y, z, A;  // where it begins, and z and A there
    double width;
    double power;           // e^(-s y)
    Sums before;            // integrals up to it
    double rest, lag_rest;  // from it to the stop
  };

  void add_piece(bool panel, double y, double width);
  void add_panels(double from, double to);
  void add_series(double from, double to);
  Sums sums(const Piece&, double y) const;
  const Piece& piece_at(double lambda) const;

  // Within a piece: y counted from its beginning, in units of e^(-s y) there.
  template <typename Integrand>
  void quadrature(const Piece&, double y, Integrand&&) const;
  double local_time(const Piece&, double y) const;
  double local_lag(const Piece&, double y) const;
  double series_lag_rest(double y) const;
  double local_distance(const Piece&, double y) const;
  Gradient local_gradient(const Piece&, double y, bool way) const;
  double panel_lambda(const Piece&, double time) const;
  double series_lambda(const Piece&, double time, double rest) const;

  double z(double y) const;  // and A, at y from the start
  double A(double y) const;

  double b_, s_, K_, depth_, arm_square_;
  std::vector<Piece> pieces_;
  std::vector<Term> series_;
  double stop_ = std::numeric_limits<double>::infinity();
  double end_ = std::numeric_limits<double>::infinity();
};

}  // namespace rolling
