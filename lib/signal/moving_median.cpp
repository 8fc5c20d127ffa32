#include "signal/moving_median.h"

#include <algorithm>

namespace rolling {

double MovingMedian::value(const Windows& window) {
  window.slide(
      begin_, end_,
      [this](const Sample& s) {
    sorted_.insert(std::upper_bound(sorted_.begin(), sorted_.end(), s.y), s.y);
      },
      [this](const Sample& s) {
    sorted_.erase(std::lower_bound(sorted_.begin(), sorted_.end(), s.y));
  });
  return sorted_[sorted_.size() / 2];  // their number is odd
}

}  // namespace rolling
