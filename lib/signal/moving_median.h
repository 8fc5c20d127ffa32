// SPDX-License-Identifier: GPL-3.0-or-later
// The median over a centred window, which shrinks symmetrically at the ends of a run; a monotonic
// sequence is unchanged.
#pragma once

#include "signal/signal.h"
#include "signal/sorted_window.h"

namespace rolling {

class MovingMedian : public WindowedSignal<MovingMedian> {
 public:
  /// Throws Error for an even width.
  explicit MovingMedian(Width width) : WindowedSignal(width, Windows::Ends::shrink) {}

  double value(const Windows& window) {
    if (begin_ + 1 == window.begin() && end_ + 1 == window.end())
      sorted_.exchange(window.sample(end_++).y, window.sample(begin_++).y);
    else
      window.slide(
          begin_, end_, [this](const Sample& s) { sorted_.insert(s.y); },
          [this](const Sample& s) { sorted_.erase(s.y); });
    return sorted_.median();
  }

 private:
  SortedWindow sorted_;
  std::size_t begin_ = 0, end_ = 0;  // range of the samples in sorted_
};

}  // namespace rolling
