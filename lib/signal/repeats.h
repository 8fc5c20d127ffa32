// Readings that a logger wrote more than once because no newer one had come.
#pragma once

#include <span>

namespace rolling {

/// How many records a reading was held for, on average; 1 if the readings were not held.
///
/// Held readings stay the same and then jump. Rounded readings repeat too, but in steps of one or
/// two units: normal steps that are mostly larger are 0 in at most one case of six. So readings
/// count as held if more than a quarter of the steps are 0 and fewer than half of the others are
/// one or two times the smallest (to 2 %, or to the last digit that is written). Held readings
/// that fall in equal steps cannot be told from rounded ones, and do not count; nor does rest (0).
double records_held(std::span<const double> readings);

}  // namespace rolling
