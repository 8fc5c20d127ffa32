// The median over a centred window, which at the ends of a run shrinks symmetrically: a straight
// line, indeed anything that only rises or only falls, comes out as itself. The window is kept
// sorted: O(w) moves a sample, in one block of memory.
#pragma once

#include "signal/signal.h"

namespace rolling {

class MovingMedian : public WindowedSignal<MovingMedian> {
 public:
  /// Throws Error for an even width.
  explicit MovingMedian(Width width) : WindowedSignal(width, Windows::Ends::shrink) {}

  double value(const Windows&);

 private:
  std::vector<double> sorted_;
  std::size_t begin_ = 0, end_ = 0;  // the samples in sorted_
};

}  // namespace rolling
