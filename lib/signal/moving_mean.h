// The mean over a centred window, one sample in at a time. At the ends the window shrinks
// symmetrically, so a straight line comes out as itself. Each mean is within 1 ulp of the exact
// mean of its window, whatever came before it.
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
  std::size_t begin_ = 0, end_ = 0;  // the samples in sum_
};

}  // namespace rolling
