// SPDX-License-Identifier: GPL-3.0-or-later
// What readings tell of the sensor and the logger: their noise, whether they were held, and whether
// they are pulses.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "signal/windows.h"

namespace rolling {

/// The noise of samples while the body moves: the median scatter about the parabolas of few
/// neighbours. Where a body moves by less than a step of rounded positions it is at least that of
/// rounding.
double noise_of(std::span<const Sample> samples, bool positions, double step);

/// Of how many rows a program has made each reading by a mean, as the readings show; 1: of its own
/// alone. And the noise of means: n of them tell as much as n/rows readings of the sensor, so that
/// the variance that each of them stands for is so many times its own; 0 for one row.
///
/// Third differences hold the noise and hardly any motion. If readings are means of m rows, those
/// of rows that are m apart are correlated by -1/2, where the window of one begins and that of the
/// other ends. The number is the one whose correlations are nearest to those that are seen, for
/// other filters too, if it is clearly nearer than those of raw readings and of speeds that a
/// sensor differences, and if readings three rows apart differ more than neighbours do.
struct Means {
  std::size_t rows = 1;
  double noise = 0;
};
Means means_of_rows(std::span<const Sample> samples);

/// Whether a logger repeated readings because no newer one had arrived.
///
/// Held readings stay constant between two jumps. Readings on a grid repeat, too: rounded ones, and
/// differences of rounded ones. They do so between steps of a unit or two, or at the beginning and
/// the end of a run, where the body rests: these repetitions do not count. The unit is the lower
/// quartile of the steps if three in five are multiples of it, else at most 8 times the last place
/// that was written. By chance readings on a grid repeat between larger steps as well. The chance
/// that a step is 0 is at most half the unit over the median size of the other steps: of normal
/// steps that are large it is 0.27 of that. Readings therefore count as held if there are more than
/// one repetition for three stretches between jumps, and so many by chance less than once in a
/// hundred times.
///
/// Held readings that fall in equal steps cannot be distinguished from a grid and do not count; nor
/// does rest (readings of 0).
bool are_held(std::span<const double> readings);

/// Readings that jump off the motion: those that are further from the median of themselves and five
/// neighbours on either side than a fifth of the range of such medians, than six times the median
/// distance of these eleven, than eight times that of the whole run, and than three steps of a grid
/// that the readings lie on. Of long runs some thousand readings are looked at.
struct Spikes {
  std::size_t found = 0, among = 0;
  Sample first{};
};
Spikes spikes_in(std::span<const Sample> run);

/// The first reading after a counter of positions has started over: a jump by almost the range of
/// all readings, against a motion that goes on after it as before.
std::optional<std::size_t> start_over(std::span<const Sample> run);

/// The way [m] from one pulse to the next, with the sign of the speeds, if each speed but the first
/// times the time since the row before it (or each but the last times that to the row after it) is
/// that one way, as far as the numbers are written, and the times between rows differ enough to
/// tell. The rows then are the pulses: row i is i ways from the first, and its time is what was
/// measured. Row by row the speed is the mean one over an interval that grows as the body slows
/// down, and not that of the row.
std::optional<double> way_between_pulses(std::span<const double> t, std::span<const double> v);

/// Times that were rounded to a place in which a step from row to row is no whole number: 30 rows a
/// second to 0.01 s have steps of 0.03 and of 0.04 s. Nothing if fewer than one step in ten is
/// longer or shorter than the usual one by that place; if it is less than a twentieth of the usual
/// step, which hardly matters; or if it is almost that step, which lost rows look like.
struct RoundedTimes {
  double place = 0;  ///< [s]
  double step = 0;   ///< the mean one, but for those over lost rows [s]
};
std::optional<RoundedTimes> rounded_times(std::span<const double> t);

/// The way that the positions cover over that which the speeds of the same rows cover: 1 if both
/// are of one body in one system of units. It is the median over stretches of half the rows, so
/// that a few readings that are off do not count. Speeds are added up by trapezoids; an interval
/// counts if all its numbers are finite. NaN for fewer than ten rows, and at rest.
double ways_ratio(std::span<const double> t, std::span<const double> x, std::span<const double> v);

}  // namespace rolling
