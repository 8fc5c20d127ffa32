// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that a body hardly has: a unit is probably another one. They are told, not refused.
#pragma once

#include <cmath>

#include "contact/body.h"
#include "statistics/levels.h"

namespace rolling {

/// A cylinder of iron of this radius and mass would be 40 times as long as thick. A cart, with a K
/// of about 0, may have any mass.
inline bool is_hardly_so_heavy(const Body& body) {
  return body.K > 0.1 && body.m > levels::heavy * body.R * body.R * body.R;
}

/// A body that rolls as a whole, or a vehicle, hardly has such a speed [m/s].
inline bool is_hardly_so_fast(const Body& body, double v) {
  const bool is_vehicle = body.K < levels::K_of_vehicles;
  return std::abs(v) >
         (is_vehicle ? levels::fast_vehicle : levels::fast * std::sqrt(body.g * body.R));
}

}  // namespace rolling
