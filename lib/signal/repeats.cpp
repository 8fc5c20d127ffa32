#include "signal/repeats.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/rounding.h"

namespace rolling {
namespace {

/// The last decimal place of the readings: the greatest power of ten that divides all of them.
double last_place(std::span<const double> readings, double rounding) {
  double place = 1;
  for (const double y : readings)
    while (place > rounding && std::abs(y - std::round(y / place) * place) > rounding) place /= 10;
  return place;
}

}  // namespace

double records_held(std::span<const double> readings) {
  double largest = 0;
  for (const double y : readings) largest = std::max(largest, std::abs(y));
  const double rounding = program_rounding * largest;
  const auto step = [&](std::size_t i) { return std::abs(readings[i] - readings[i - 1]); };
  std::size_t changes = 0, repeats = 0;
  double unit = std::numeric_limits<double>::infinity();  // the smallest step
  for (std::size_t i = 1; i < readings.size(); ++i)
    if (step(i) > rounding) ++changes, unit = std::min(unit, step(i));
    else ++repeats;
  if (changes == 0 || changes >= 3 * repeats) return 1;
  const double place = last_place(readings, rounding) + rounding;
  const auto is_units = [&](double jump) {
    const double units = jump < 1.5 * unit ? 1 : 2;
    return jump < 2.5 * unit &&
           std::abs(jump - units * unit) <= std::max(0.02 * jump, units * place);
  };
  std::size_t jumps = 0, waiting = 0, held = 0, stretches = 0;  // held between two jumps
  bool after_jump = false;
  for (std::size_t i = 1; i < readings.size(); ++i) {
    if (step(i) <= rounding) {
      waiting += readings[i] != 0;
      continue;
    }
    const bool jump = !is_units(step(i));
    if (jump && after_jump) held += waiting, ++stretches;
    jumps += jump;
    after_jump = jump;
    waiting = 0;
  }
  if (jumps >= 3 * held) return 1;
  return 1 + static_cast<double>(held) / static_cast<double>(stretches);
}

}  // namespace rolling
