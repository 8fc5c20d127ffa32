// SPDX-License-Identifier: GPL-3.0-or-later
// The roll whose motion is Eq. 13.
#pragma once

#include <memory>

#include "motion/scene.h"

namespace rolling {

inline std::unique_ptr<Motion> closed_roll(const Body& body, PowerLaw law, double v0,
                                           double x0 = 0) {
  return start({body, law, {0}, v0, x0}, {Method::closed}, 0);
}

}  // namespace rolling
