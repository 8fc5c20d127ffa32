// SPDX-License-Identifier: GPL-3.0-or-later
// Detection of outliers: the distance of each reading from the motion of its neighbours.
#pragma once

#include <deque>

#include "signal/signal.h"

namespace rolling {

/// A reading is an outlier if it lies further from the local motion than `threshold` standard
/// errors of a prediction.
///
/// The local motion is the parabola through the ten nearest readings without the one in question,
/// five on either side, at the ends of a run the first or last 25; where they scatter, through
/// all but three of them, those that lie on a parabola best (least trimmed squares, Rousseeuw 1984,
/// J. Am. Stat. Assoc. 79, 871), and then all within four standard deviations of it, so that a
/// burst of three does not decide. The scatter is that of
/// the readings of the window about their parabolas (its lower quartile, which outliers hardly
/// move); that of the best, if it is 4.5 times as large: a push or a stop bends the motion itself.
/// The scatter is at least a third of the smallest first or second difference so far, which is the
/// last digit of readings that are rounded, however fast the body moves: a step of it is no
/// outlier. In a window of less than 33 samples it is 1.5 times that of the best. Windows are cut
/// off at the ends of a run and hold 151 samples or more, because the scatter of few is often far
/// too small. About 1 us for a sample, 30 us where it scatters.
class Outliers {
 public:
  Outliers(Width, double threshold);

  /// As in Signal: the samples that have now been tested, in order; y of an outlier is NaN.
  std::span<const Sample> push(double t, double y);
  std::span<const Sample> finish();

 private:
  void judge();
  std::deque<Sample>::const_iterator at(std::size_t i) const;
  bool belongs(std::size_t i, double noise) const;
  double least_scatter() const;
  bool few() const;

  Windows near_;     // ten neighbours and the sample
  Windows scatter_;  // root of the RSS of each near window, as a reading at its time
  double threshold_;
  double before_ = 0, last_ = 0;  // the last two readings
  double large_ = 0;              // the largest reading so far that a neighbour reaches too
  double step_ = 0;               // the smallest difference so far
  Sliding<SortedWindow> sorted_;
  std::deque<Sample> samples_;  // of the run, from the index first_ on
  std::size_t first_ = 0, count_ = 0;
  std::vector<Sample> judged_;
};

}  // namespace rolling
