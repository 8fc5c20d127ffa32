// SPDX-License-Identifier: GPL-3.0-or-later
// The mean over a centred window, computed sample by sample. At the ends of a run the window
// shrinks symmetrically, so that a straight line is unchanged. Each mean is within 1 ulp of the
// exact mean of its window, independent of earlier readings.
#pragma once

#include "signal/exact_sum.h"
#include "signal/signal.h"

namespace rolling {

class MovingMean : public WindowedSignal<MovingMean> {
 public:
  /// Throws Error for an even width.
  explicit MovingMean(Width width) : WindowedSignal(width, Windows::Ends::shrink) {}

  double value(const Windows& window) {
    if (begin_ + 1 == window.begin() && end_ + 1 == window.end())
      sum_.exchange(window.sample(end_++).y, window.sample(begin_++).y);
    else
      window.slide(
          begin_, end_, [this](const Sample& s) { sum_.add(s.y); },
          [this](const Sample& s) { sum_.subtract(s.y); });
    return sum_.over(window.size());
  }

 private:
  ExactSum sum_;
  std::size_t begin_ = 0, end_ = 0;  // range of the samples in sum_
};

}  // namespace rolling
