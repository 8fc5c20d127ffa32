#include "signal/moving_mean.h"

namespace rolling {

double MovingMean::value(const Windows& window) {
  window.slide(begin_, end_, [this](const Sample& s) { sum_.add(s.y); }, [this](const Sample& s) { sum_.subtract(s.y); });
  return sum_.over(window.size());
}

}  // namespace rolling
