// SPDX-License-Identifier: GPL-3.0-or-later
// The rolling body, its mat, and the geometry of their contact.
#pragma once

#include <array>
#include <span>

#include "base/estimate.h"

namespace rolling {

class Road;

/// A round body that rolls without sliding; J = K m R^2 (Eq. 2).
struct Body {
  double m;          ///< mass [kg]
  double R;          ///< radius [m]
  double K;          ///< shape factor: 1/2 solid cylinder, 1 thin shell
  double g = 9.81;   ///< gravity [m/s^2]
  double slope = 0;  ///< of the mat: tan theta, above 0 if x grows uphill
  /// The standard uncertainties, each in the unit of its number; 0 if none is given.
  double sigma_R = 0, sigma_K = 0, sigma_g = 0, sigma_slope = 0;
  double wind = 0;             ///< speed of the air towards falling x [m/s], for a law with d2 v^2
  const Road* road = nullptr;  ///< the height of the track, to which the slope adds a constant
  double steepness = 1;        ///< factor of that height
  /// The arm of F_H is A R. In the exact geometry A = sqrt(1 - D^2/R^2) (Eq. 8), else A = 1, as in
  /// the paper's simulations (Eqs. 11 to 13).
  bool exact = false;
};

/// A number of a body, as the tools name it.
struct NumberOfBody {
  const char* name;
  double Body::*value;
  double Body::*sigma;  ///< nullptr for one without an uncertainty

  Estimate of(const Body& body) const { return {body.*value, sigma ? body.*sigma : 0}; }
};
inline constexpr std::array<NumberOfBody, 5> numbers_of_body = {
    {{"K", &Body::K, &Body::sigma_K},
     {"R", &Body::R, &Body::sigma_R},
     {"g", &Body::g, &Body::sigma_g},
     {"slope", &Body::slope, &Body::sigma_slope},
     {"wind", &Body::wind, nullptr}}};
/// Those that may have a standard uncertainty.
inline constexpr std::span uncertain_numbers = std::span(numbers_of_body).first<4>();

}  // namespace rolling
