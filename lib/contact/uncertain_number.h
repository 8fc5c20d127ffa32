// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers of a body that may be given with a standard uncertainty, in the order in which the
// history of shift-from-accel has them.
#pragma once

#include <array>

#include "contact/body.h"

namespace rolling {

struct UncertainNumber {
  const char* name;
  double Body::*value;
  double BodyUncertainty::*sigma;
};
inline constexpr std::array<UncertainNumber, 4> uncertain_numbers = {
    {{"K", &Body::K, &BodyUncertainty::K},
     {"R", &Body::R, &BodyUncertainty::R},
     {"g", &Body::g, &BodyUncertainty::g},
     {"slope", &Body::slope, &BodyUncertainty::slope}}};

}  // namespace rolling
