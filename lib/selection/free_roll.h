// SPDX-License-Identifier: GPL-3.0-or-later
// Search for the free roll in a run: among rest, push, hold, hand, brake, wall and way back.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "signal/windows.h"

namespace rolling {

/// The samples [begin, end) of a run, and the times of the first and the last of them.
struct Stretch {
  std::size_t begin, end;
  double from = 0, to = 0;
};

struct FreeRoll {
  enum class End { by_itself, is_ended, goes_on, speeds_up, stays };

  Stretch kept;
  End how;  ///< at rest; by a hand, a brake, a wall, ...; not before the run is over; slow, before
            ///< the speed grows again, or stays as it is
  double after;      ///< the time at which something else begins, if it does not go on
  double speed = 0;  ///< at which it stays
  std::optional<Stretch> other{};  ///< another roll, or what may be the roll as well
};

/// The free roll in a run of positions or speeds of at least 10 samples.
///
/// A run is a chain of smooth motions with sudden changes between them: the best partition into
/// pieces (selection/pieces.h), of samples that are on the motion of their neighbours
/// (selection/outliers.h). Rest, push, hold, roll, hand, brake, wall and way back are all pieces
/// with a speed and an acceleration. A reading that a logger held for several rows counts once.
///
/// Pieces that slow down, one after the other, are one roll if neither speed nor acceleration jumps
/// between them: a law D(v) is continuous. On a slope, a body that turns goes on with an
/// acceleration of the same sign. The longest of several rolls is the free one; a line names a
/// second one if it lasts 0.4 of that, or if the roll follows it with a larger deceleration, as
/// behind a brake.
///
/// A joint is as uncertain as noise makes it. Kept are the samples of the roll that belong to it
/// wherever the joint lies within three standard errors, less those at its ends that do not agree
/// with the rest of it, less the time in which a push or a hand stays within two standard
/// deviations of the noise. Where the roll is slow at its end, the joint is that of a body that
/// stops by itself, whose speed does not jump: a short rest, too, shows when. If the readings speak
/// against that by five standard errors, something else ended the roll. A hand that slows a slow
/// body by hardly more than D leaves hardly a joint: if such a hand agrees with the readings by 2.5
/// standard errors better than a stop, the roll ends where it begins.
///
/// A run of more than 1000 samples is reduced to means of equal numbers of samples; if the roll is
/// short, the search is repeated around it. O(n). Throws Error if no roll is found.
FreeRoll free_roll(std::span<const Sample> run, bool positions);

/// All free rolls of such a run, in the order of their times; free_roll() is the longest.
///
/// The free rolls of one body have one law: at the same speed they slow down alike. A stretch is a
/// roll if its mean deceleration is within a factor of 1.5 of that which the others show at its
/// speeds, and no part of it is off by more than twice that and four standard errors. The law is
/// the one that most of the rolling time follows. A hand, a brake, and a body that is carried back
/// slow down otherwise.
std::vector<FreeRoll> free_rolls(std::span<const Sample> run, bool positions);

}  // namespace rolling
