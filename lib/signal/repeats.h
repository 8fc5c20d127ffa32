// Detection of readings that a logger repeated because no newer reading had arrived.
#pragma once

#include <span>

namespace rolling {

/// The mean number of records for which a reading was held; 1 if readings were not held.
///
/// Held readings stay constant between two jumps. Rounded readings repeat, too, but between steps
/// of one or two units, the smallest step (to 2 %, or to the last written digit); or they stay at
/// the beginning and the end of a record, where the body rests: these repetitions do not count. If
/// normally distributed steps are mostly larger than that, at most one in six is 0. Readings
/// therefore count as held if the repetitions between jumps are more than a third of the jumps.
/// Held readings that fall in equal steps cannot be distinguished from rounded ones and do not
/// count; nor does rest (readings of 0).
double records_held(std::span<const double> readings);

}  // namespace rolling
