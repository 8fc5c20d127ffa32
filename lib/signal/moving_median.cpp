#include "signal/moving_median.h"

namespace rolling {

double MovingMedian::value(const Windows& window) {
  window.slide(
      begin_, end_, [this](const Sample& s) { sorted_.insert(s.y); },
      [this](const Sample& s) { sorted_.erase(s.y); });
  return sorted_.median();
}

}  // namespace rolling
