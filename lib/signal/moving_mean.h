// The mean over a centred window, one sample in at a time. At the ends the window shrinks symmetrically, so a straight
// line comes out as itself. Each mean is within 1 ulp of the exact mean of its window, whatever came before it.
#pragma once

#include "signal/exact_sum.h"
#include "signal/signal.h"

namespace rolling {

class MovingMean : public WindowedSignal {
 public:
  /// Throws Error for an even width.
  explicit MovingMean(Width width) : WindowedSignal(width, Windows::Ends::shrink) {}

 private:
  double value(const Windows&) override;

  ExactSum sum_;
  std::size_t begin_ = 0, end_ = 0;  // the samples in sum_
};

}  // namespace rolling
