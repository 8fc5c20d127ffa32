// SPDX-License-Identifier: GPL-3.0-or-later
// What a roll shows of its law, and whether two rolls are of one.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace rolling {

/// A speed, and the deceleration at it, with its standard error.
struct Slowing {
  double v, deceleration, error;
};

/// The deceleration at a speed, of a law that is ordered by the speeds; beyond the speeds that were
/// seen, that at the nearest.
inline double at(const std::vector<Slowing>& law, double v) {
  const auto above = std::ranges::lower_bound(law, v, {}, &Slowing::v);
  if (above == law.begin()) return above->deceleration;
  const Slowing& below = *(above - 1);
  if (above == law.end()) return below.deceleration;
  const double part = (v - below.v) / (above->v - below.v);
  return std::lerp(below.deceleration, above->deceleration, part);
}

/// Whether a body that rolls under `law` slows down like `other`, within this factor.
inline bool are_alike(const std::vector<Slowing>& law, const std::vector<Slowing>& other,
                      double factor) {
  double found = 0;
  double expected = 0;
  for (const Slowing& s : other) {
    const double alike = at(law, s.v);
    if (std::abs(s.deceleration - alike) > 4 * s.error + (factor + 0.5) * alike) return false;
    found += s.deceleration;
    expected += alike;
  }
  return found > expected / factor && found < factor * expected;
}

}  // namespace rolling
