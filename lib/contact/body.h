// The rolling body, and how the arm of its horizontal force is taken.
#pragma once

namespace rolling {

/// A round body that rolls without sliding; J = K m R^2 (Eq. 2).
struct Body {
  double m;          ///< mass [kg]
  double R;          ///< radius [m]
  double K;          ///< shape factor: 1/2 solid cylinder, 1 thin shell
  double g = 9.81;   ///< gravity [m/s^2]
  double slope = 0;  ///< of the mat: tan theta, metres that it rises a metre along growing x
};

/// The arm of F_H is A R: the paper takes A = 1 in its simulations (Eq. 11 to 13); exact is A =
/// sqrt(1 - D^2/R^2) (Eq. 8).
enum class Geometry { approximate, exact };

}  // namespace rolling
