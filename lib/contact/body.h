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

/// The standard uncertainties of what is given about a body; 0 where none is given.
struct BodyUncertainty {
  double R = 0;      ///< [m]
  double K = 0;      ///< of the shape factor
  double g = 0;      ///< [m/s^2]
  double slope = 0;  ///< of tan(theta)
};

/// The arm of F_H is A R: the paper takes A = 1 in its simulations (Eq. 11 to 13); exact is A =
/// sqrt(1 - D^2/R^2) (Eq. 8).
enum class Geometry { approximate, exact };

}  // namespace rolling
