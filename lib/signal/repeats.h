// SPDX-License-Identifier: GPL-3.0-or-later
// Detection of readings that a logger repeated because no newer reading had arrived.
#pragma once

#include <span>

namespace rolling {

/// The mean number of rows for which a reading was held; 1 if readings were not held.
///
/// Held readings stay constant between two jumps. Readings on a grid repeat, too: rounded ones, and
/// differences of rounded ones, whose unit is a multiple of the last digit that is written. They do
/// so between steps of one or two units, or at the beginning and the end of a run, where the
/// body rests: these repetitions do not count. By chance they repeat between larger steps as well.
/// The chance that a step is 0 is at most half the unit over the median size of the other steps: of
/// normal steps that are large it is 0.27 of that. Readings therefore count as held if there are
/// more than one repetition for three stretches between jumps, and so many by chance less than once
/// in a hundred times.
///
/// Held readings that fall in equal steps cannot be distinguished from a grid and do not count; nor
/// does rest (readings of 0).
double rows_held(std::span<const double> readings);

}  // namespace rolling
