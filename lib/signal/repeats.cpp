#include "signal/repeats.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

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
  const double rounding = 1e-9 * largest;  // error of a program that computed the readings
  const auto step = [&](std::size_t i) { return std::abs(readings[i] - readings[i - 1]); };
  std::size_t changes = 0, repeats = 0;  // two readings of 0 are neither
  for (std::size_t i = 1; i < readings.size(); ++i)
    if (step(i) > rounding) ++changes;
    else if (readings[i] != 0 || readings[i - 1] != 0) ++repeats;
  if (changes == 0 || changes >= 3 * repeats) return 1;
  std::vector<double> jumps;
  jumps.reserve(changes);
  for (std::size_t i = 1; i < readings.size(); ++i)
    if (step(i) > rounding) jumps.push_back(step(i));
  const double unit = *std::min_element(jumps.begin(), jumps.end());
  const auto mostly_units = [&](double place) {
    return 2 * std::count_if(
                   jumps.begin(), jumps.end(),
                   [&](double jump) {
      const double units = jump < 1.5 * unit ? 1 : 2;
      return jump < 2.5 * unit &&
             std::abs(jump - units * unit) <= std::max(0.02 * jump, units * place);
                   }) >=
        std::ssize(jumps);
  };
  // The first test nearly always decides, and it needs no decimal place.
  if (mostly_units(0) || mostly_units(last_place(readings, rounding) + rounding)) return 1;
  return static_cast<double>(changes + repeats + 1) / static_cast<double>(changes + 1);
}

}  // namespace rolling
