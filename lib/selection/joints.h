// SPDX-License-Identifier: GPL-3.0-or-later
// Where the joint between two motions of a run may lie: two polynomials, a roll and its stop, or a
// roll and a hand that stops the body.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "selection/pieces.h"
#include "signal/windows.h"

namespace rolling {

/// The index at which a roll ends, and the RSS of the motion that ends it there.
struct Ending {
  std::size_t end;
  double rss;
};

/// The joints of samples of this noise. Each RSS is in units of the variance of the noise.
class Joints {
 public:
  Joints(std::span<const Sample> samples, bool positions, double noise)
      : samples_(samples), positions_(positions), most_(most_coefficients(positions)),
        noise_(noise) {}

  /// The RSS of the samples [begin, end) as two polynomials of `order` and `order_after`
  /// coefficients, for each number of samples that the first one may have.
  std::vector<double> costs(std::size_t begin, std::size_t order, std::size_t order_after,
                            std::size_t end) const;

  /// From `joint`, at most `far` inwards (+1 or -1): the furthest joint within three standard
  /// errors of the best.
  static std::size_t inner(const std::vector<double>& cost, std::size_t joint, std::size_t far,
                           int inwards);

  /// The number of samples, of those from `from` to `to`, that agree with one another. As many as
  /// half may be left out at the end: each sample that is left out costs twice the mean square of
  /// all residuals, or 2 if that is larger.
  std::size_t agreeing(std::size_t from, std::size_t to) const;

  /// The end of a roll whose body comes to rest by itself, among the samples [begin, end), behind
  /// the middle of `begin` and `roughly`: the earliest within three standard errors of the best.
  ///
  /// At the stop, s, the speed falls to 0 without a jump. Positions are y + sum c_k (s - t)^k,
  /// k > 1, before s, and y from then on, but for the rounding that all readings of the rest share.
  /// The sum has three powers, and so has that of speeds, from k = 1 on: with fewer, a law whose
  /// speed falls like another power looks like a hand. The speed at s and behind it is any
  /// constant: that of a sensor at rest, or that at which the body is held.
  Ending before_stop(std::size_t begin, std::size_t roughly, std::size_t end) const;

  /// The same of a roll that a hand ends: it takes the speed v to 0 as v (1 + cos(pi s/T))/2,
  /// within a time T of no more than a quarter of the roll.
  Ending before_hand(std::size_t begin, std::size_t roughly, std::size_t end) const;

  /// The time for which positions do not show a change: a body that a hand moves from rest to v, or
  /// back, within T deviates from the sudden change by v T/8 at most.
  double unseen(const Piece&, double t) const;

  /// The same for the end of a push of the duration T, whose force fades: its speed is
  /// v (1 + cos(pi s/T))/2 before the release, which moves the body by v pi^2 s^3/(12 T^2) less.
  double unseen_push(const Piece& push, const Piece& roll) const;

 private:
  double rss_of_stop(std::size_t begin, std::size_t joint, double stop, std::size_t end,
                     double most) const;

  std::span<const Sample> samples_;
  bool positions_;
  std::size_t most_;  // coefficients of a piece
  double noise_;
};

}  // namespace rolling
