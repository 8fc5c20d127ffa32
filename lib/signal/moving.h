// SPDX-License-Identifier: GPL-3.0-or-later
// The mean and the median over a centred window, computed sample by sample. At the ends of a run
// the window shrinks symmetrically: the mean leaves a straight line unchanged, the median what only
// rises or falls.
#pragma once

#include "signal/exact_sum.h"
#include "signal/signal.h"
#include "signal/sorted_window.h"

namespace rolling {

/// Each mean is within 1 ulp of the exact mean of its window, independent of earlier readings.
class MovingMean : public WindowedSignal<MovingMean> {
 public:
  /// Throws Error for an even width.
  explicit MovingMean(Width width) : WindowedSignal(width, Windows::Ends::shrink) {}
  double value(const Windows& window) { return sum_.of(window).over(window.size()); }

 private:
  Sliding<ExactSum> sum_;
};

class MovingMedian : public WindowedSignal<MovingMedian> {
 public:
  /// Throws Error for an even width.
  explicit MovingMedian(Width width) : WindowedSignal(width, Windows::Ends::shrink) {}
  double value(const Windows& window) { return sorted_.of(window).median(); }

 private:
  Sliding<SortedWindow> sorted_;
};

}  // namespace rolling
