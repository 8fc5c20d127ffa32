#include "signal/moving_mean.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace rolling {

MovingMean::MovingMean(Window window) : window_(window) {
  if (window_.seconds == 0 && window_.samples % 2 == 0)
    fail("the width of a centred window is an odd number of samples, not {}", window_.samples);
}

/// Sample j lies in the window of seconds about sample i; rounding of the times does not decide it.
bool MovingMean::within(std::size_t i, std::size_t j) const {
  return std::abs(sample(j).t - sample(i).t) <= window_.seconds / 2 * (1 + 1e-9);
}

/// How many samples on either side of i the mean takes; false while samples to come could change it.
bool MovingMean::half_width(std::size_t i, bool at_end, std::size_t& k) {
  const std::size_t count = first_ + samples_.size();
  if (window_.seconds == 0) {
    const std::size_t wanted = std::min(i, window_.samples / 2);
    k = std::min(wanted, count - 1 - i);
    return k == wanted || at_end;
  }
  while (!within(i, left_)) ++left_;
  while (right_ < count && within(i, right_)) ++right_;
  k = std::min(i - left_, right_ - 1 - i);
  return k == i - left_ || right_ < count || at_end;
}

void MovingMean::emit_known(bool at_end) {
  known_.clear();
  const std::size_t count = first_ + samples_.size();
  for (std::size_t k; next_ < count && half_width(next_, at_end, k); ++next_) {
    const std::size_t begin = next_ - k, end = next_ + k + 1;
    while (begin_ > begin) sum_.add(sample(--begin_).y);
    while (end_ < end) sum_.add(sample(end_++).y);
    while (begin_ < begin) sum_.subtract(sample(begin_++).y);
    while (end_ > end) sum_.subtract(sample(--end_).y);
    known_.push_back(sum_.over(2 * k + 1));
    const std::size_t keep = window_.seconds == 0 ? begin_ : left_;
    while (first_ < keep) samples_.pop_front(), ++first_;
  }
}

std::span<const double> MovingMean::push(double t, double y) {
  samples_.push_back({t, y});
  emit_known(false);
  return known_;
}

std::span<const double> MovingMean::finish() {
  emit_known(true);
  return known_;
}

}  // namespace rolling
