// Detection of readings that a logger repeated because no newer reading had arrived.
#pragma once

#include <span>

namespace rolling {

/// The mean number of records for which a reading was held; 1 if readings were not held.
///
/// Held readings stay constant and then jump. Rounded readings repeat, too, but change by one or
/// two units: if normally distributed steps are mostly larger than that, at most one in six is 0.
/// Readings therefore count as held if more than a quarter of the steps are 0 and fewer than half
/// of the others are one or two times the smallest step (to 2 %, or to the last written digit).
/// Held readings that fall in equal steps cannot be distinguished from rounded ones and do not
/// count; nor does rest (readings of 0).
double records_held(std::span<const double> readings);

}  // namespace rolling
