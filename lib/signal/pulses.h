// SPDX-License-Identifier: GPL-3.0-or-later
// Speeds that are a fixed way over the time between two pulses.
#pragma once

#include <optional>
#include <span>

namespace rolling {

/// The way [m] from one pulse to the next, with the sign of the speeds, if each speed but the first
/// times the time since the row before it (or each but the last times that to the row after it) is
/// that one way, as far as the numbers are written, and the times between rows differ enough to
/// tell. The rows then are the pulses: row i is i ways from the first, and its time is what was
/// measured. Row by row the speed is the mean one over an interval that grows as the body slows
/// down, and not that of the row.
std::optional<double> way_between_pulses(std::span<const double> t, std::span<const double> v);

}  // namespace rolling
